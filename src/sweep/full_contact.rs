//! Full contact, once for all cells that share it.
//!
//! While the block stands on both corners u and v do not see each other, (5). Under a record u(t)
//! depends on T_h alone and v(t) on T_v alone: a grid of N by N periods holds 2 N such motions. Under
//! a pulse both depend on Omega alone, and u is proportional to A_h, for u_y is (21): N motions for a
//! grid of N columns, and v is at rest where A_v = 0. They are integrated through the excitation; a
//! cell compares its two and begins its own integration at the first gap between samples (of a pulse,
//! the first step) in which it may lift. A cell that never may is done at the excitation's end, or
//! goes on from there.

use fearless_simd::Level;
use rayon::prelude::*;

use super::cell_tables::Place;
use super::plan::Plan;
use super::shared_motion::{Direction, Track};
use super::tracks::{ACCELERATION, DISPLACEMENT, LEAST, Motions, PEAK, VELOCITY};
use super::tracks::{CREST, EIGHTHS_V, LOWEST, QUARTERS_H, TROUGH, VERTICAL_FIELDS};
use super::tracks::{DEEPEST, HIGHEST, HORIZONTAL_FIELDS, HYSTERETIC, MOST, STRONGEST};
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::scene::{Excitation, Grid, Point};

/// Most memory for the motions, bytes; a grid that needs more goes without.
const MOST_MEMORY: usize = 1 << 29;
/// The full-contact motions of a plan's grid.
#[derive(Debug)]
pub struct Tracks<R> {
    /// Of u: by column of the grid; one where all are alike.
    pub(super) across: Motions<R>,
    /// Of v: by row under a record, by column under a pulse; one where all are alike.
    pub(super) up: Motions<R>,
    /// The base does not move vertically before the block lifts.
    pub(super) still: bool,
    /// H, and the two lever arms.
    pub(super) height: R,
    pub(super) arms: [R; 2],
    /// The vectors of this machine.
    pub(super) level: Level,
}

impl Plan {
    /// A_h that shared motions of u are of, m/s^2, to which they are proportional; none under a
    /// record, where they are every cell's own.
    pub(super) fn shared_amplitude(&self) -> Option<f64> {
        match &self.scene.excitation {
            Excitation::Record(_) => None,
            Excitation::Pulse(pulse) => Some(pulse.a_h.start.abs().max(pulse.a_h.stop.abs())),
        }
    }
}

impl<R: Real> Tracks<R> {
    /// The motions of a grid, under the plan's record; none where cells do not share them (a block that starts tilted), where
    /// the plan leaves nothing out, or where they take too much memory.
    pub fn of(plan: &Plan, grid: &Grid, record: &[Ground<R>]) -> Option<Tracks<R>> {
        let (width, height) = grid.shape();
        let base = &plan.scene.isolation;
        let amplitude = plan.shared_amplitude();
        let (by_row, still) = match &plan.scene.excitation {
            Excitation::Record(_) => (true, false),
            Excitation::Pulse(pulse) => (false, pulse.a_v == 0.0),
        };
        let across = if by_row && base.horizontal.is_none() { 1 } else { width };
        let up = match (by_row, still) {
            (_, true) => 1,
            (true, _) if base.vertical.is_none() => 1,
            (true, _) => height,
            (false, _) => width,
        };
        let samples = |motions: usize| match &plan.scene.excitation {
            Excitation::Record(pair) => motions * pair.len(),
            Excitation::Pulse(_) => {
                let steps = |column| plan.clock(&grid.point(column)).steps_forced as usize;
                (0..motions).map(|column| steps(column) + 1).sum()
            }
        };
        let numbers = samples(across) * HORIZONTAL_FIELDS + samples(up) * VERTICAL_FIELDS;
        let bytes = numbers * size_of::<R>();
        // As many motions as cells save nothing.
        let pays = across + up < grid.len() && amplitude != Some(0.0);
        if !plan.reductions.full_contact || plan.scene.tilt != 0.0 || bytes > MOST_MEMORY || !pays {
            return None;
        }
        // X by itself: over g it is the friction asked for where the ground does not move vertically.
        let level: Vec<Ground<R>> =
            record.iter().map(|ground| Ground { v: R::of(0.0), ..*ground }).collect();
        let (only_h, only_v) = (plan.without_vertical(), plan.without_horizontal());
        let of = |direction: Direction, mut point: Point| {
            let (alone, record) = match direction {
                Direction::Horizontal => (&only_h, &level[..]),
                Direction::Vertical => (&only_v, record),
            };
            // Under a pulse the steps are those of the cells.
            let clock = if by_row { alone } else { plan };
            point.a_h = amplitude.unwrap_or(point.a_h);
            Track::new(clock, alone.variant(), &point, direction, record)
        };
        let columns = (0..across).into_par_iter();
        let along_x = columns.map(|column| of(Direction::Horizontal, grid.point(column))).collect();
        let first = |index: usize| grid.point(if by_row { index * width } else { index });
        let along_y = (0..up).into_par_iter();
        let along_y = along_y.map(|index| of(Direction::Vertical, first(index))).collect();
        let stride = |count: usize, by_row: bool| -> Place {
            let step = usize::from(count > 1);
            if by_row { [0, step] } else { [step, 0] }
        };
        let model = plan.model::<R>();
        Some(Tracks {
            across: horizontal(along_x, stride(across, false)),
            up: vertical(along_y, stride(up, by_row)),
            still,
            height: model.height,
            arms: [model.left.arm, model.right.arm],
            level: Level::new(),
        })
    }
}

/// Motions of u, as they are kept.
fn horizontal<R: Real>(tracks: Vec<Track<R>>, strides: Place) -> Motions<R> {
    let lengths = tracks.iter().map(|track| track.motion.len());
    let mut motions = Motions::new(HORIZONTAL_FIELDS, lengths, strides);
    for (number, track) in tracks.iter().enumerate() {
        motions.fill(DISPLACEMENT, number, track.motion.iter().map(|motion| motion.u));
        motions.fill(VELOCITY, number, track.motion.iter().map(|motion| motion.du));
        motions.fill(ACCELERATION, number, track.acceleration.iter().copied());
        motions.fill(LEAST, number, track.least.iter().copied());
        motions.fill(PEAK, number, track.peak.iter().copied());
        motions.fill(HYSTERETIC, number, track.motion.iter().map(|motion| motion.z));
        motions.fill(MOST, number, track.most.iter().copied());
        motions.fill(HIGHEST, number, track.highest.iter().copied());
        motions.fill(DEEPEST, number, track.deepest.iter().copied());
        motions.fill(STRONGEST, number, track.strongest.iter().copied());
        motions.fill(CREST, number, track.crest.iter().copied());
        for (quarter, values) in track.inside.iter().enumerate() {
            motions.fill(QUARTERS_H + quarter, number, values.iter().copied());
        }
    }
    motions
}

/// Motions of v, as they are kept.
fn vertical<R: Real>(tracks: Vec<Track<R>>, strides: Place) -> Motions<R> {
    let lengths = tracks.iter().map(|track| track.motion.len());
    let mut motions = Motions::new(VERTICAL_FIELDS, lengths, strides);
    for (number, track) in tracks.iter().enumerate() {
        motions.fill(DISPLACEMENT, number, track.motion.iter().map(|motion| motion.v));
        motions.fill(VELOCITY, number, track.motion.iter().map(|motion| motion.dv));
        motions.fill(ACCELERATION, number, track.acceleration.iter().copied());
        motions.fill(LEAST, number, track.least.iter().copied());
        motions.fill(PEAK, number, track.peak.iter().copied());
        motions.fill(LOWEST, number, track.lowest.iter().copied());
        motions.fill(TROUGH, number, track.crest.iter().copied());
        for (eighth, values) in track.inside.iter().enumerate() {
            motions.fill(EIGHTHS_V + eighth, number, values.iter().copied());
        }
    }
    motions
}
