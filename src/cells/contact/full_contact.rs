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
use super::shared_motion::{MotionSet, Start};
use super::sharing::sharing;
use crate::cells::cell_list::CellList;
use crate::cells::listing::{Entries, Index, occurring};
use crate::cells::plan::Plan;
use crate::cells::window::Combinations;
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::{Grid, Parameter};
use crate::stepping::spans::Direction;
use crate::work::observer::Observer;
use crate::work::parallel;
use crate::work::vectors::lanes_of;

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

/// The motions that a list needs, together with those that are there already. They are those of the whole grid where
/// these are no more than the cells of the list, or no more than twice as many as the list needs.
fn wanted(
    (grid, cells): (&Grid, CellList),
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
        (grid, cells): (&Grid, CellList),
        known: Option<&FullContactMotions<R>>,
        record: &[Ground<R>],
        observer: &dyn Observer,
    ) -> Option<FullContactMotions<R>> {
        let amplitude = shared_amplitude(plan, grid);
        let of = Dependence::of(plan, grid);
        let all = of.combinations(grid);
        let after = match known {
            Some(known) => known.after,
            None => sharing(plan, grid, &all, (of.still, size_of::<R>()))?.1,
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
                parallel::each(missing.len(), parallel::SHORT, |number| start(&missing[number]));
            let lengths = starts.iter().map(Start::samples);
            let mut motions = kept.with_room(direction.fields(plan.asked.forces), lengths);
            let mut slots = kept.fill(&mut motions);
            parallel::each_slice(&mut slots, lanes, |number, slots| {
                if observer.cancelled() {
                    return;
                }
                let starts = &starts[number * lanes..][..slots.len()];
                let set = MotionSet { variant, direction, record, starts };
                bounded_motions::integrate(set, slots, level);
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
    pub(crate) fn index(&self, grid: &Grid, cells: CellList) -> [Index; 2] {
        [&self.across, &self.up].map(|motions| motions.entries.index(grid, cells))
    }

    /// True where all motions that a list needs are there.
    pub(crate) fn hold(&self, grid: &Grid, cells: CellList) -> bool {
        [&self.across, &self.up].iter().all(|motions| motions.entries.hold(grid, cells))
    }

    /// Motions of u and of v, by their numbers, under the record.
    #[inline(always)]
    pub(crate) fn pair<'a>(
        &'a self,
        [across, up]: [usize; 2],
        record: &'a [Ground<R>],
    ) -> MotionPair<'a, R> {
        let FullContactMotions { still, variant, level, .. } = *self;
        let (across, up) = (self.across.at(across), self.up.at(up));
        MotionPair { across, up, still, variant, record, level }
    }
}
