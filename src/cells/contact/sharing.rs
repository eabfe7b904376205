//! Whether the cells of a grid share their motions in [full contact](super::full_contact), and how much memory these take.

use super::dependence::{Dependence, shared_amplitude};
use crate::cells::laws::Laws;
use crate::cells::plan::Plan;
use crate::cells::window::Combinations;
use crate::model::precision::Precision;
use crate::scene::{Excitation, Grid};
use crate::stepping::certificate::STEPS_A_TRY;
use crate::stepping::spans::Direction;

/// Largest memory for the motions, bytes; where a grid needs more, each cell integrates its own full contact.
const MOST_MEMORY: usize = 1 << 29;
/// The number of cells that take as long as a motion that they share, where no contact forces are requested: under
/// 148 motions, of grids of 6 x 6, 8 x 8, 10 x 10 and 16 x 16 over (T_h, T_v), sharing took 1.35, 1.13, 0.88 and 0.53 of
/// the time.
const CELLS_A_MOTION: usize = 4;

/// The largest number of steps for which motions are continued after a pulse: some periods of the base, in which a
/// base that will still move farther than before does so. Of 400 x 400 cells 60,948 of the 63,492 that never lift are
/// final by then.
const AFTER_PULSE: u32 = 20 * STEPS_A_TRY;

/// The number of steps for which motions are continued after the excitation. In these steps the energy proves cells
/// final. Where the ground moves the block directly there are none: its force may jump at the end of the excitation,
/// so that a gap does not begin with the value with which the gap before it ends.
fn steps_after(plan: &Plan, still: bool) -> u32 {
    let Laws { moves: [h, v], .. } = plan.laws;
    let pulse = plan.scene.excitation.record().is_none();
    if pulse && plan.shortcuts.certificate && h && (v || still) { AFTER_PULSE } else { 0 }
}

/// How many numbers, of so many bytes each, the motions of these combinations have with so many steps after the excitation, where
/// they fit in memory. The motions of a pulse are counted one by one until they do not fit.
fn fit(
    plan: &Plan,
    grid: &Grid,
    all: &[Combinations; 2],
    (after, bytes): (u32, usize),
) -> Option<usize> {
    let most = MOST_MEMORY / bytes;
    let mut left = most;
    let directions = [Direction::Horizontal, Direction::Vertical];
    let fields = directions.map(|direction| direction.fields(plan.asked.forces));
    let fits = all.iter().zip(fields).all(|(all, fields)| {
        let most = left / fields;
        let samples = match &plan.scene.excitation {
            Excitation::Record(pair) => all.count().saturating_mul(pair.len()),
            // A motion has two samples at least.
            Excitation::Pulse(_) if all.count() > most / 2 => most + 1,
            Excitation::Pulse(_) => {
                let mut samples = 0;
                for number in 0..all.count() {
                    let clock = plan.clock(&grid.case_at(&all.place(number)));
                    let after = after.min(clock.steps - clock.steps_forced);
                    samples += (clock.steps_forced + after) as usize + 1;
                    if samples > most {
                        break;
                    }
                }
                samples
            }
        };
        left = left.saturating_sub(samples.saturating_mul(fields));
        samples <= most
    });
    fits.then_some(most - left)
}

/// True where the cells of a grid share the motions of these combinations. With as many motions as cells nothing is saved;
/// without forces a cell is so cheap that one motion takes as long as several cells.
fn shares(plan: &Plan, grid: &Grid, all: &[Combinations; 2]) -> bool {
    let each = if plan.asked.forces { 1 } else { CELLS_A_MOTION };
    let motions = all[0].count().saturating_add(all[1].count()).saturating_mul(each);
    let pays = grid.len() > motions && shared_amplitude(plan, grid) != Some(0.0);
    plan.shortcuts.full_contact && plan.shares_contact() && !grid.tilts() && pays
}

/// How many numbers, of so many bytes each, the motions of these combinations have where the cells of a grid share them, and the
/// steps after the excitation; none where they share none. `still`: the base does not move vertically before the block lifts.
pub(super) fn sharing(
    plan: &Plan,
    grid: &Grid,
    all: &[Combinations; 2],
    (still, bytes): (bool, usize),
) -> Option<(usize, u32)> {
    if !shares(plan, grid, all) {
        return None;
    }
    let mut most = [steps_after(plan, still), 0].into_iter();
    most.find_map(|after| Some((fit(plan, grid, all, (after, bytes))?, after)))
}

/// Bytes of the motions in full contact that the cells of a grid share.
pub fn bytes_shared(plan: &Plan, grid: &Grid, precision: Precision) -> usize {
    let bytes = match precision {
        Precision::F32 => size_of::<f32>(),
        Precision::F64 => size_of::<f64>(),
    };
    let of = Dependence::of(plan, grid);
    let shared = sharing(plan, grid, &of.combinations(grid), (of.still, bytes));
    shared.map_or(0, |(numbers, _)| numbers * bytes)
}
