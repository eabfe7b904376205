//! The sweep on the CPU. Its loop is the twin of `shaders/sweep.wgsl`.

use bytemuck::Zeroable;
use fearless_simd::Level;
use rayon::prelude::*;

use super::cells::Cells;
use super::lanes;
use super::plan::Plan;
use crate::integrate::certificate::{certify, is_due};
use crate::integrate::log::{Event, Kept};
use crate::integrate::outcome::Outcome;
use crate::integrate::state::{RUNNING, State};
use crate::integrate::switching::{Log, advance};
use crate::model::Setting;
use crate::model::real::Real;
use crate::scene::Grid;

/// Takes a cell on until its steps and switches come to `work`.
pub fn sweep_cell<R: Real>(
    set: &Setting<R>,
    state: &mut State<R>,
    work: u32,
    log: &mut impl Log<R>,
) {
    let mut done = 0;
    while done < work && state.status == RUNNING {
        done += 1 + advance(set, state, log);
        if state.status == RUNNING && is_due(set, state) {
            certify(set, state);
        }
    }
}

/// Steps and switches of a cell at a time.
const CHUNK: u32 = 1 << 20;

/// Cells that a thread takes at once.
const BLOCK: usize = 16;

/// Runs cells of a grid on all cores, on vectors where the plan allows it; `progress` hears of each
/// cell done.
pub fn sweep<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
) -> Vec<Outcome> {
    if lanes::can_run(plan) {
        return lanes::sweep::<R>(plan, grid, cells, progress, Level::new());
    }
    sweep_one_by_one::<R>(plan, grid, cells, progress)
}

/// The same, a cell at a time: the twin of the shader.
pub fn sweep_one_by_one<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
) -> Vec<Outcome> {
    let ran = each::<R, ()>(plan, grid, cells, progress, || ());
    ran.into_iter().map(|(outcome, ())| outcome).collect()
}

/// The same, with the first `events_kept` switches of each cell.
pub fn sweep_keeping<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    events_kept: usize,
) -> (Vec<Outcome>, Vec<Event<R>>) {
    let ran = each(plan, grid, cells, &|_| (), || Kept(vec![Event::zeroed(); events_kept]));
    let (outcomes, events): (Vec<Outcome>, Vec<Kept<R>>) = ran.into_iter().unzip();
    (outcomes, events.into_iter().flat_map(|kept| kept.0).collect())
}

fn each<R: Real, L: Log<R> + Send>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
    log: impl Fn() -> L + Sync,
) -> Vec<(Outcome, L)> {
    let model = plan.model::<R>();
    let variant = plan.variant();
    let record = plan.record::<R>();
    let all = Cells::of(plan, grid, &record);
    let mut outcomes = Vec::with_capacity(cells.len());
    cells
        .par_iter()
        .with_max_len(BLOCK)
        .map(|&index| {
            let (cell, mut state) = all.begin(index);
            let set = Setting { variant, model: &model, cell: &cell, record: &record };
            let mut log = log();
            while state.status == RUNNING {
                sweep_cell(&set, &mut state, CHUNK, &mut log);
            }
            progress(1);
            (all.outcome(index, &state), log)
        })
        .collect_into_vec(&mut outcomes);
    outcomes
}
