//! The sweep on the CPU: on vectors, or one cell at a time where the switches are kept.

use bytemuck::Zeroable;
use fearless_simd::Level;

use super::cell_run::CellRun;
use super::lanes;
use crate::cells::plan::Plan;
use crate::cells::ready::Cells;
use crate::model::CellEquations;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::scene::Grid;
use crate::stepping::log::{Event, FirstSwitches, Log};
use crate::stepping::outcome::Outcome;
use crate::stepping::single;
use crate::work::observer::{Observer, Unwatched};
use crate::work::parallel;

/// The number of cells that a thread takes at once: few, because a cell may take many times as long as another, and the last part
/// keeps a single thread busy.
const BLOCK: usize = 16;

/// Runs cells of a grid on all cores, once each, on the widest vectors of this machine; `observer` is told of cells
/// that are done. Their numbers are those of the columns, as wide as the number type; those of [`sweep_one_by_one`] are not
/// rounded to it.
pub fn sweep(
    precision: Precision,
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    observer: &dyn Observer,
) -> Vec<Outcome> {
    lanes::sweep(&CellRun::of(plan, grid, cells, precision), observer, Level::new()).to_outcomes()
}

/// The same with one cell at a time: vectors of one lane.
pub fn sweep_one_by_one(
    precision: Precision,
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    observer: &dyn Observer,
) -> Vec<Outcome> {
    match precision {
        Precision::F32 => outcomes::<f32>(plan, grid, cells, observer),
        Precision::F64 => outcomes::<f64>(plan, grid, cells, observer),
    }
}

fn outcomes<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    observer: &dyn Observer,
) -> Vec<Outcome> {
    let ran = each::<R, ()>(plan, grid, cells, observer, || ());
    ran.into_iter().map(|(outcome, ())| outcome).collect()
}

/// The same, and keeps the first `events_kept` switches of each cell.
pub fn sweep_keeping<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    events_kept: usize,
) -> (Vec<Outcome>, Vec<Event<R>>) {
    let none = || FirstSwitches(vec![Event::zeroed(); events_kept]);
    let ran = each(plan, grid, cells, &Unwatched, none);
    let (outcomes, events): (Vec<Outcome>, Vec<FirstSwitches<R>>) = ran.into_iter().unzip();
    (outcomes, events.into_iter().flat_map(|kept| kept.0).collect())
}

fn each<R: Real, L: Log<R> + Send>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    observer: &dyn Observer,
    log: impl Fn() -> L + Sync,
) -> Vec<(Outcome, L)> {
    let variant = plan.variant();
    let record = plan.record::<R>();
    let all = Cells::of(plan, grid, cells, &record, observer);
    parallel::each(cells.len(), BLOCK, |number| {
        let (cell, state) = all.begin(number);
        let model = &all.bodies()[cell.body as usize];
        let set = CellEquations::of(variant, model, &cell, &record);
        let mut log = log();
        let state = single::run(&set, &state, &mut log);
        observer.advance(1);
        (all.outcome(number, &state), log)
    })
}
