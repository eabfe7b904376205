//! Full contact, once for all cells that share it.
//!
//! While the block stands on both corners u and v are coupled neither to each other, (5), nor to the
//! block: u(t) depends on the horizontal isolation and the ground, v(t) on the vertical isolation and the
//! ground. Under a record a grid of N values of T_h by N of T_v has 2 N such motions, N of u and N of v;
//! a grid of blocks has two, one of each. Under a pulse they have the cells' steps, which depend on Omega
//! and the periods, and u is proportional to A_h where u_y is (21): a map of N frequencies has N motions,
//! and v is at rest where A_v = 0. They are integrated through the excitation; a cell compares its two
//! and begins its own integration at the first gap between samples (of a pulse, the first step) in which
//! it may lift. A cell that cannot lift under the excitation is done at its end, or goes on from there.

use fearless_simd::Level;
use rayon::prelude::*;

use super::bounded_motions;
use super::clock_parts::clock_parameters;
use super::motions::{
    ACCELERATION, BOTTOM, CREST, DEEPEST, DISPLACEMENT, EIGHTHS_V, HIGHEST, HORIZONTAL_FIELDS,
    HYSTERETIC, LEAST, LIGHTEST, LOWEST, MOST, Motions, QUARTERS_H, STRONGEST, TOP, TROUGH,
    VELOCITY, VERTICAL_FIELDS,
};
use super::motions_with_forces;
use super::plan::Plan;
use super::progress::Progress;
use super::shared_motion::{Direction, MotionBatch, Sample, SampledMotion, Start};
use super::table::{Strides, Window, places_of, strides};
use super::vectors::lanes_of;
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::isolation::{HORIZONTAL, VERTICAL};
use crate::scene::{Excitation, Grid, Parameter};

/// Largest memory for the motions, bytes; for a grid that needs more each cell integrates its own full
/// contact.
const MOST_MEMORY: usize = 1 << 29;
/// Cells that take as long as a motion that they share, where contact forces are not asked for: under 148 motions, of
/// grids of 6 x 6, 10 x 10 and 16 x 16 over (T_h, T_v), sharing took 1.6, 1.4 and 0.66 of the time.
const CELLS_A_MOTION: usize = 7;
/// The full-contact motions of a plan's grid.
#[derive(Debug)]
pub struct FullContactMotions<R> {
    /// Of u: one for each combination of what it depends on.
    pub(super) across: Motions<R>,
    /// Of v: the same.
    pub(super) up: Motions<R>,
    /// The base does not move vertically before the block lifts.
    pub(super) still: bool,
    /// Forces inside gaps are known.
    pub(super) forces: bool,
    /// The vector instructions of this machine.
    pub(super) level: Level,
}

/// The masses that a base's yield force in newtons is divided by.
const MASSES: [Parameter; 3] = [Parameter::Mass, Parameter::PlateH, Parameter::PlateV];
/// The parameters that the ground's motion depends on, beside a pulse's amplitudes.
const GROUND: [Parameter; 6] = [
    Parameter::Scale,
    Parameter::Pga,
    Parameter::Omega,
    Parameter::Cycles,
    Parameter::Gamma,
    Parameter::Phase,
];

/// The parameters that the motions of each direction depend on, and whether v is at rest.
struct Dependence {
    across: Vec<Parameter>,
    up: Vec<Parameter>,
    still: bool,
}

impl Dependence {
    fn of(plan: &Plan, grid: &Grid) -> Dependence {
        let base = plan.scene.isolation;
        let recorded = plan.scene.excitation.record().is_some();
        let still = !recorded
            && grid
                .corners()
                .all(|case| case.shaking.pulse().is_some_and(|pulse| pulse.a_v == 0.0));
        let (mut across, mut up) = (GROUND.to_vec(), Vec::new());
        if base.moves_h() {
            across.extend(HORIZONTAL);
            if grid.gives_strength() {
                across.extend(MASSES);
            }
        }
        if !still {
            up.extend(GROUND);
            up.push(Parameter::AV);
        }
        if base.moves_v() {
            // At rest it hangs by its static deflection.
            up.extend(if still { &[Parameter::TV][..] } else { &VERTICAL });
        }
        if !recorded {
            // The steps of a pulse are those of the cells.
            across.extend(clock_parameters(grid));
            if plan.shared_amplitude(grid).is_none() {
                across.push(Parameter::AH);
            }
            if !still {
                up.extend(clock_parameters(grid));
            }
        }
        Dependence { across, up, still }
    }
}

impl Plan {
    /// A_h of the shared motions of u, m/s^2: by (21) u is proportional to it. None under a record, and
    /// where the base's strength is given: there u is not proportional to A_h.
    pub(super) fn shared_amplitude(&self, grid: &Grid) -> Option<f64> {
        if self.scene.excitation.record().is_some() || grid.gives_strength() {
            return None;
        }
        let amplitudes = grid.corners().map(|case| case.shaking.peak_h());
        Some(amplitudes.fold(0.0, f64::max))
    }
}

impl<R: Real> FullContactMotions<R> {
    /// The motions of a grid, under the plan's record; none where cells do not share them (a block that
    /// starts tilted), where the plan has no such shortcut, where they take too much memory, or where
    /// `progress` ends the work.
    pub fn of(
        plan: &Plan,
        grid: &Grid,
        record: &[Ground<R>],
        progress: &dyn Progress,
    ) -> Option<FullContactMotions<R>> {
        let amplitude = plan.shared_amplitude(grid);
        let of = Dependence::of(plan, grid);
        let window = Window::whole(grid);
        let across = window.entries(grid, &of.across);
        let up = window.entries(grid, &of.up);
        // With as many motions as cells there is nothing to save. Without forces a cell is so cheap that a motion takes as
        // long as some of them.
        let each = if plan.forces { 1 } else { CELLS_A_MOTION };
        let pays = grid.len() > each * (across + up) && amplitude != Some(0.0);
        if !plan.reductions.full_contact || grid.tilts() || !pays {
            return None;
        }
        let samples = |parameters: &[Parameter], motions: usize| match &plan.scene.excitation {
            Excitation::Record(pair) => motions * pair.len(),
            Excitation::Pulse(_) => {
                let steps = |place| plan.clock(&grid.case_at(&place)).steps_forced as usize;
                places_of(grid, parameters).map(|place| steps(place) + 1).sum()
            }
        };
        let numbers =
            samples(&of.across, across) * HORIZONTAL_FIELDS + samples(&of.up, up) * VERTICAL_FIELDS;
        if numbers * size_of::<R>() > MOST_MEMORY {
            return None;
        }
        let (only_h, only_v) = (plan.without_vertical(), plan.without_horizontal());
        let recorded = plan.scene.excitation.record().is_some();
        let level = Level::new();
        let all = |direction: Direction, parameters: &[Parameter]| {
            let alone = if direction == Direction::Horizontal { &only_h } else { &only_v };
            let variant = alone.variant();
            // Under a pulse the steps are those of the cells.
            let clock = if recorded { alone } else { plan };
            let start = |place: &Place| {
                let case = match amplitude {
                    Some(amplitude) => grid.case_with(place, Parameter::AH, amplitude),
                    None => grid.case_at(place),
                };
                Start::of(clock, &case, direction)
            };
            let some = |places: &[Place]| {
                let starts: Vec<Start<R>> = places.iter().map(start).collect();
                let batch = MotionBatch { variant, direction, record, starts: &starts };
                if plan.forces {
                    motions_with_forces::sample(batch, level)
                } else {
                    bounded_motions::sample(batch, level)
                }
            };
            let wanted = |places| (!progress.cancelled()).then(|| some(places));
            let places: Vec<Place> = places_of(grid, parameters).collect();
            let motions =
                places.par_chunks(lanes_of::<R>(level)).map(wanted).collect::<Option<Vec<_>>>()?;
            Some(motions.into_iter().flatten().collect::<Vec<SampledMotion<R>>>())
        };
        // The stiffest vertical isolation takes the most steps: the motions of v begin first.
        let (along_y, along_x) = rayon::join(
            || all(Direction::Vertical, &of.up),
            || all(Direction::Horizontal, &of.across),
        );
        let (along_x, along_y) = (along_x?, along_y?);
        let (up, across) = rayon::join(
            || vertical(&along_y, strides(grid, &window, &of.up)),
            || horizontal(&along_x, strides(grid, &window, &of.across)),
        );
        Some(FullContactMotions { across, up, still: of.still, forces: plan.forces, level })
    }
}

/// Stores what motions of both directions have, in so many fields, of which `crest` and those from `inside` on are each
/// direction's own.
fn stored<R: Real>(
    [fields, crest, inside]: [usize; 3],
    sampled: &[SampledMotion<R>],
    strides: Strides,
) -> Motions<R> {
    let lengths = sampled.iter().map(|each| each.samples.len());
    let mut motions = Motions::new(fields, lengths, strides);
    for (number, each) in sampled.iter().enumerate() {
        let mut fill = |field, of: fn(&Sample<R>) -> R| {
            motions.fill(field, number, each.samples.iter().map(of));
        };
        fill(DISPLACEMENT, |sample| sample.displacement);
        fill(VELOCITY, |sample| sample.velocity);
        fill(ACCELERATION, |sample| sample.acceleration);
        fill(TOP, |sample| sample.top);
        motions.fill(LEAST, number, each.gaps().map(|gap| gap.least));
        motions.fill(crest, number, each.gaps().map(|gap| gap.crest));
        for (part, values) in each.inside.iter().enumerate() {
            motions.fill(inside + part, number, values.iter().copied());
        }
    }
    motions
}

/// Stores motions of u.
fn horizontal<R: Real>(sampled: &[SampledMotion<R>], strides: Strides) -> Motions<R> {
    let mut motions = stored([HORIZONTAL_FIELDS, CREST, QUARTERS_H], sampled, strides);
    for (number, each) in sampled.iter().enumerate() {
        motions.fill(HYSTERETIC, number, each.samples.iter().map(|sample| sample.hysteretic));
        motions.fill(MOST, number, each.gaps().map(|gap| gap.most));
        motions.fill(HIGHEST, number, each.highest.iter().copied());
        motions.fill(DEEPEST, number, each.deepest.iter().copied());
        motions.fill(STRONGEST, number, each.strongest.iter().copied());
    }
    motions
}

/// Stores motions of v.
fn vertical<R: Real>(sampled: &[SampledMotion<R>], strides: Strides) -> Motions<R> {
    let mut motions = stored([VERTICAL_FIELDS, TROUGH, EIGHTHS_V], sampled, strides);
    for (number, each) in sampled.iter().enumerate() {
        motions.fill(BOTTOM, number, each.samples.iter().map(|sample| sample.bottom));
        motions.fill(LOWEST, number, each.samples.iter().map(|sample| sample.lowest));
        motions.fill(LIGHTEST, number, each.deepest.iter().map(|deepest| -*deepest));
    }
    motions
}
