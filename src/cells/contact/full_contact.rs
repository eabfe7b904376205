//! Full contact, integrated once for all cells that share it.
//!
//! While the block stands on both corners u and v are coupled neither to each other, (5), nor to the
//! block: u(t) depends on the horizontal isolation and the ground, v(t) on the vertical isolation and the
//! ground. Under a record a grid of N values of T_h by N of T_v has 2 N such motions, N of u and N of v;
//! a grid of blocks has two, one of each. Under a pulse they have the cells' steps, which depend on Omega
//! and the periods, and u is proportional to A_h where u_y is (21): a map of N frequencies has N motions,
//! and v is at rest where A_v = 0. They are integrated through the excitation; a cell compares its two
//! and begins its own integration at the first gap between samples (of a pulse, the first step) in which
//! it may lift. After a pulse they go on for a while: there a cell that lifts no more is final, and is done without an
//! integration of its own.

use fearless_simd::Level;

use super::bounded_motions;
use super::dependence::{Dependence, shared_amplitude};
use super::kept_motions::Kept;
use super::motions::{MotionPair, Motions};
use super::motions_with_forces;
use super::shared_motion::{MotionSet, Start};
use crate::cells::laws::Laws;
use crate::cells::listing::{Entries, Index, occurring};
use crate::cells::plan::Plan;
use crate::cells::window::Combinations;
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::{Excitation, Grid, Parameter};
use crate::stepping::certificate::STEPS_A_TRY;
use crate::stepping::spans::Direction;
use crate::work::observer::Observer;
use crate::work::parallel;
use crate::work::vectors::lanes_of;

/// Largest memory for the motions, bytes; where a grid needs more, each cell integrates its own full contact.
const MOST_MEMORY: usize = 1 << 29;
/// The number of cells that take as long as a motion that they share, where no contact forces are requested: under
/// 148 motions, of grids of 6 x 6, 8 x 8, 10 x 10 and 16 x 16 over (T_h, T_v), sharing took 1.35, 1.13, 0.88 and 0.53 of
/// the time.
const CELLS_A_MOTION: usize = 4;

/// The full-contact motions that cells of a plan's grid share.
#[derive(Debug)]
pub struct FullContactMotions<R> {
    /// The motions of u: one for each combination of the values that they depend on.
    pub(crate) across: Motions<R>,
    /// The motions of v, likewise.
    pub(crate) up: Motions<R>,
    /// The base does not move vertically before the block lifts.
    pub(crate) still: bool,
    /// The variant of the model that the cells have.
    variant: Variant,
    /// Steps after the excitation.
    after: u32,
    /// The vector instructions of this machine.
    pub(crate) level: Level,
}

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

/// Bytes of the motions of these combinations, with so many steps after the excitation, where they fit in memory. The motions
/// of a pulse are counted one by one until they do not fit.
fn fit<R: Real>(plan: &Plan, grid: &Grid, all: &[Combinations; 2], after: u32) -> Option<usize> {
    let most = MOST_MEMORY / size_of::<R>();
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
    fits.then_some((most - left) * size_of::<R>())
}

/// True where the cells of a grid share the motions of these combinations. With as many motions as cells nothing is saved;
/// without forces a cell is so cheap that one motion takes as long as several cells.
fn shares(plan: &Plan, grid: &Grid, all: &[Combinations; 2]) -> bool {
    let each = if plan.asked.forces { 1 } else { CELLS_A_MOTION };
    let motions = all[0].count().saturating_add(all[1].count()).saturating_mul(each);
    let pays = grid.len() > motions && shared_amplitude(plan, grid) != Some(0.0);
    plan.shortcuts.full_contact && plan.shares_contact() && !grid.tilts() && pays
}

/// The bytes of the motions that the cells of a grid share, and the steps after the excitation; none where they share none.
fn sharing<R: Real>(plan: &Plan, grid: &Grid) -> Option<(usize, u32)> {
    let of = Dependence::of(plan, grid);
    let all = of.combinations(grid);
    let mut most =
        [steps_after(plan, of.still), 0].into_iter().filter(|_| shares(plan, grid, &all));
    most.find_map(|after| Some((fit::<R>(plan, grid, &all, after)?, after)))
}

/// Bytes of the motions in full contact that the cells of a grid share.
pub fn bytes_shared(plan: &Plan, grid: &Grid, precision: Precision) -> usize {
    let shared = match precision {
        Precision::F32 => sharing::<f32>(plan, grid),
        Precision::F64 => sharing::<f64>(plan, grid),
    };
    shared.map_or(0, |(bytes, _)| bytes)
}

/// The motions that a list needs, together with those that are there already. They are those of the whole grid where
/// these are no more than the cells of the list, or no more than twice as many as the list needs.
fn wanted(
    (grid, cells): (&Grid, &[usize]),
    all: [Combinations; 2],
    known: Option<[&Entries; 2]>,
) -> [Entries; 2] {
    let count = all[0].count().saturating_add(all[1].count());
    if count <= cells.len() {
        return all.map(Entries::all);
    }
    let needed = [0, 1].map(|k| {
        let mut needed = occurring(grid, &all[k], cells);
        if let Some(known) = known.map(|known| known[k]) {
            needed.extend((0..known.count()).map(|entry| known.combination(entry)));
            needed.sort_unstable();
            needed.dedup();
        }
        needed
    });
    if 2 * (needed[0].len() + needed[1].len()) >= count {
        return all.map(Entries::all);
    }
    let [across, up] = needed;
    [Entries::some(all[0], across), Entries::some(all[1], up)]
}

impl<R: Real> FullContactMotions<R> {
    /// The motions that some cells of a grid need, under the plan's record, with those that are `known`; none where
    /// cells do not share them (a block that starts tilted), where the plan has no such shortcut, where those of the
    /// whole grid take too much memory, or where `observer` ends the work.
    pub fn of(
        plan: &Plan,
        (grid, cells): (&Grid, &[usize]),
        known: Option<&FullContactMotions<R>>,
        record: &[Ground<R>],
        observer: &dyn Observer,
    ) -> Option<FullContactMotions<R>> {
        let amplitude = shared_amplitude(plan, grid);
        let of = Dependence::of(plan, grid);
        let all = of.combinations(grid);
        let after = match known {
            Some(known) => known.after,
            None => sharing::<R>(plan, grid)?.1,
        };
        let known = known.map(|known| [&known.across, &known.up]);
        let wanted =
            wanted((grid, cells), all, known.map(|known| known.map(|motions| &motions.entries)));
        let (only_h, only_v) = (plan.without_vertical(), plan.without_horizontal());
        let recorded = plan.scene.excitation.record().is_some();
        let level = Level::new();
        let lanes = lanes_of::<R>(level);
        let sampled = |direction: Direction, kept: &Kept<R>| {
            let alone = if direction == Direction::Horizontal { &only_h } else { &only_v };
            // The energy proves more of a cell than of a motion in one direction.
            let variant = Variant { certificate: false, ..alone.variant() };
            // Under a pulse the steps are those of the cells.
            let clock = if recorded { alone } else { plan };
            let start = |place: &Place| {
                let case = match amplitude {
                    Some(amplitude) => grid.case_with(place, Parameter::AH, amplitude),
                    None => grid.case_at(place),
                };
                Start::of(clock, &case, direction, after)
            };
            let missing = kept.missing();
            let starts: Vec<Start<R>> =
                parallel::each(missing.len(), 64, |number| start(&missing[number]));
            let lengths = starts.iter().map(Start::samples);
            let mut motions = kept.with_room(direction.fields(plan.asked.forces), lengths);
            let mut slots = kept.fill(&mut motions);
            parallel::each_slice(&mut slots, lanes, |number, slots| {
                let starts = &starts[number * lanes..][..slots.len()];
                let set = MotionSet { variant, direction, record, starts };
                match plan.asked.forces {
                    _ if observer.cancelled() => {}
                    true => motions_with_forces::integrate(set, slots, level),
                    false => bounded_motions::integrate(set, slots, level),
                }
            });
            (!observer.cancelled()).then_some(motions)
        };
        let [across, up] = wanted;
        let across = Kept::of(across, known.map(|known| known[0]));
        let up = Kept::of(up, known.map(|known| known[1]));
        // The stiffest vertical isolation takes the most steps: therefore the motions of v begin first.
        let (up, across) = rayon::join(
            || sampled(Direction::Vertical, &up),
            || sampled(Direction::Horizontal, &across),
        );
        let (up, across) = (up?, across?);
        let (still, variant) = (of.still, plan.variant());
        Some(FullContactMotions { across, up, still, variant, after, level })
    }

    /// Where the cells of a list find their motions of u and of v.
    pub(crate) fn index(&self, grid: &Grid, cells: &[usize]) -> [Index; 2] {
        [&self.across, &self.up].map(|motions| motions.entries.index(grid, cells))
    }

    /// True where all motions that a list needs are there.
    pub(crate) fn hold(&self, grid: &Grid, cells: &[usize]) -> bool {
        [&self.across, &self.up].iter().all(|motions| motions.entries.hold(grid, cells))
    }

    /// Motions of u and of v, by their numbers.
    #[inline(always)]
    pub(crate) fn pair(&self, [across, up]: [usize; 2]) -> MotionPair<'_, R> {
        let FullContactMotions { still, variant, level, .. } = *self;
        MotionPair { across: self.across.at(across), up: self.up.at(up), still, variant, level }
    }
}
