//! The sweep on the CPU. Its loop is the twin of `shaders/sweep.wgsl`.

use std::sync::atomic::{AtomicUsize, Ordering};

use bytemuck::Zeroable;
use fearless_simd::{Level, dispatch};
use rayon::prelude::*;

use super::full_contact::Tracks;
use super::plan::Plan;
use crate::integrate::certificate::{certify, is_due};
use crate::integrate::lanes::{Job, Lanes, Shared};
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

/// Runs cells of a grid on all cores; `progress` hears of each cell done.
pub fn sweep<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
) -> Vec<Outcome> {
    if !plan.variant().in_step || std::env::var("SCALAR").is_ok() {
        let ran = each::<R, ()>(plan, grid, cells, progress, || ());
        return ran.into_iter().map(|(outcome, ())| outcome).collect();
    }
    let level = Level::new();
    sweep_lanes::<R>(plan, grid, cells, progress, level)
}

/// Cells that a thread takes from the queue at once.
const BATCH: usize = 64;

fn sweep_lanes<R: Real>(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
    level: Level,
) -> Vec<Outcome> {
    let model = plan.model::<R>();
    let record = plan.record::<R>();
    let tracks = Tracks::of(plan, grid, &record);
    let shared = Shared { variant: plan.variant(), model: &model, record: &record };
    let queue = AtomicUsize::new(0);
    let ran = rayon::broadcast(|_| {
        let mut batch = 0..0;
        let mut ended = Vec::new();
        let next = || {
            if batch.is_empty() {
                let from = queue.fetch_add(BATCH, Ordering::Relaxed).min(cells.len());
                batch = from..(from + BATCH).min(cells.len());
            }
            let number = batch.next()?;
            let index = cells[number];
            let point = grid.point(index);
            let (cell, mut state) = plan.cell::<R>(&point);
            if let Some(tracks) = &tracks {
                tracks.begin(index, &point, &cell, &mut state);
            }
            Some(Job { number, cell, state })
        };
        let done = |job: &Job<R>| {
            progress(1);
            let point = grid.point(cells[job.number]);
            ended.push((job.number, plan.outcome(&point, &job.state)));
        };
        dispatch!(level, simd => Lanes::new(shared, R::of(0.0).lanes(simd)).run(next, done));
        ended
    });
    let mut outcomes = vec![None; cells.len()];
    for (number, outcome) in ran.into_iter().flatten() {
        outcomes[number] = Some(outcome);
    }
    outcomes.into_iter().flatten().collect()
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
    let tracks = Tracks::of(plan, grid, &record);
    let mut outcomes = Vec::with_capacity(cells.len());
    cells
        .par_iter()
        .with_max_len(BLOCK)
        .map(|&index| {
            let point = grid.point(index);
            let (cell, mut state) = plan.cell::<R>(&point);
            let set = Setting { variant, model: &model, cell: &cell, record: &record };
            if let Some(tracks) = &tracks {
                tracks.begin(index, &point, &cell, &mut state);
            }
            let mut log = log();
            while state.status == RUNNING {
                sweep_cell(&set, &mut state, CHUNK, &mut log);
            }
            progress(1);
            (plan.outcome(&point, &state), log)
        })
        .collect_into_vec(&mut outcomes);
    outcomes
}
