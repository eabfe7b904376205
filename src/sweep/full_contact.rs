//! Full contact, once for all cells that share it.
//!
//! While the block stands on both corners u and v do not see each other, (5). Under a record u(t)
//! depends on T_h alone and v(t) on T_v alone: a grid of N by N periods holds 2 N such motions. Under
//! a pulse both depend on Omega alone, and u is proportional to A_h, for u_y is (21): N motions for a
//! grid of N columns, and v is at rest where A_v = 0. They are integrated through the excitation; a
//! cell compares its two and begins its own integration at the first gap between samples (of a pulse,
//! the first step) in which it may lift. A cell that never may is done at the excitation's end, or
//! goes on from there.

use rayon::prelude::*;

use super::plan::Plan;
use crate::model::CellEquations;
use crate::model::block::{FULL_CONTACT, pivot};
use crate::model::dynamics::{Motion, rates};
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::{Excitation, Grid, Point};
use crate::stepping::forcing::ground_at;
use crate::stepping::single::Single;
use crate::stepping::state::{FINISHED, RUNNING, State};

/// Most memory for the motions, bytes; a grid that needs more goes without.
const MOST_MEMORY: usize = 1 << 29;
/// Share of its largest value by which an acceleration may exceed those seen at the ends of steps:
/// 80 steps a period leave 8e-4.
const CREST: f64 = 2.0e-3;

/// Gaps that a cell is looked through at once.
const BLOCK: usize = 16;

/// The bounds of a block of gaps from a sample on, the upper and the lower ones, and the acceleration
/// at its samples; none where as many are not left.
#[inline(always)]
fn block<R>(track: &Track<R>, from: usize) -> Option<(&[R; BLOCK], &[R; BLOCK], &[R; BLOCK])> {
    let most = track.most.get(from..)?.first_chunk()?;
    let least = track.least.get(from..)?.first_chunk()?;
    let acceleration = track.acceleration.get(from..)?.first_chunk()?;
    Some((most, least, acceleration))
}

/// A motion in one direction, sample by sample.
struct Track<R> {
    /// At each sample.
    motion: Vec<Motion<R>>,
    /// X or Y of (14) at each sample, m/s^2.
    acceleration: Vec<R>,
    /// Bounds of it from each sample to the next.
    least: Vec<R>,
    most: Vec<R>,
    /// Largest |u| or |v| up to each sample, m.
    peak: Vec<R>,
    /// Least of the acceleration up to each sample.
    lowest: Vec<R>,
    /// Largest upper bound, largest lower bound turned about, and largest magnitude of the
    /// acceleration, up to and with each gap.
    highest: Vec<R>,
    deepest: Vec<R>,
    strongest: Vec<R>,
}

/// Which of the two directions a track is of.
#[derive(Clone, Copy, PartialEq)]
enum Direction {
    Horizontal,
    Vertical,
}

/// The full-contact motions of a plan's grid.
pub struct Tracks<R> {
    /// Of u: by column of the grid; one where all are alike.
    across: Vec<Track<R>>,
    /// Of v: by row under a record, by column under a pulse; one where all are alike.
    up: Vec<Track<R>>,
    by_row: bool,
    /// The base does not move vertically before the block lifts.
    still: bool,
    /// A_h that the motions of u are of, m/s^2; none where they are every cell's own.
    amplitude: Option<f64>,
    width: usize,
    height: R,
    arms: [R; 2],
}

impl<R: Real> Tracks<R> {
    /// The motions of a grid, under the plan's record; none where cells do not share them (a block that starts tilted), where
    /// the plan leaves nothing out, or where they take too much memory.
    pub fn of(plan: &Plan, grid: &Grid, record: &[Ground<R>]) -> Option<Tracks<R>> {
        let (width, height) = grid.shape();
        let base = &plan.scene.isolation;
        let (gaps, amplitude, by_row, still) = match &plan.scene.excitation {
            Excitation::Record(pair) => (pair.len(), None, true, false),
            Excitation::Pulse(pulse) => {
                let most = pulse.a_h.start.abs().max(pulse.a_h.stop.abs());
                let steps = plan.clock(&grid.extreme()).steps_forced as usize;
                (steps, Some(most), false, pulse.a_v == 0.0)
            }
        };
        let across = if by_row && base.horizontal.is_none() { 1 } else { width };
        let up = match (by_row, still) {
            (_, true) => 1,
            (true, _) if base.vertical.is_none() => 1,
            (true, _) => height,
            (false, _) => width,
        };
        let bytes = (across + up) * gaps * (size_of::<Motion<R>>() + 8 * size_of::<R>());
        // As many motions as cells save nothing.
        let pays = across + up < grid.len() && amplitude != Some(0.0);
        if !plan.reductions.full_contact || plan.scene.tilt != 0.0 || bytes > MOST_MEMORY || !pays {
            return None;
        }
        let of = |direction: Direction, mut point: Point| {
            let alone = match direction {
                Direction::Horizontal => plan.without_vertical(),
                Direction::Vertical => plan.without_horizontal(),
            };
            // Under a pulse the steps are those of the cells.
            let clock = if by_row { &alone } else { plan };
            point.a_h = amplitude.unwrap_or(point.a_h);
            Track::new(clock, alone.variant(), &point, direction, record)
        };
        let columns = (0..across).into_par_iter();
        let across = columns.map(|column| of(Direction::Horizontal, grid.point(column))).collect();
        let first = |index: usize| grid.point(if by_row { index * width } else { index });
        let up: Vec<Track<R>> =
            (0..up).into_par_iter().map(|index| of(Direction::Vertical, first(index))).collect();
        let model = plan.model::<R>();
        let arms = [model.left.arm, model.right.arm];
        Some(Tracks { across, up, by_row, still, amplitude, width, height: model.height, arms })
    }

    /// Takes a cell from its start to the first gap in which it may lift, or to the end of the
    /// excitation.
    #[inline(always)]
    fn begin(&self, index: usize, point: &Point, cell: &Cell<R>, state: &mut State<R>) {
        if state.status != RUNNING {
            return;
        }
        let (column, row) = (index % self.width, index / self.width);
        let h = &self.across[column.min(self.across.len() - 1)];
        let place = if self.by_row { row } else { column };
        let v = &self.up[place.min(self.up.len() - 1)];
        // u is A_h times what it is for A_h = 1.
        let scale = R::of(self.amplitude.map_or(1.0, |amplitude| point.a_h / amplitude));
        let lever = self.height * scale;
        let (left, right) = (self.arms[0], self.arms[1]);
        let zero = R::of(0.0);
        let mut friction = zero;
        let mut sample = 0;
        // The last sample ends no gap. A motion of v at rest is as long as it is asked for.
        let last = h.motion.len() - 1;
        let lifts = |most: R, least: R, least_y: R| {
            // A negative lever turns the bounds about.
            let (one, other) = (lever * most, lever * least);
            (one.max(other) > left * least_y) | ((-one).max(-other) > right * least_y)
        };
        if self.still {
            // Nothing but u changes from gap to gap: the first that lifts is searched for.
            let (y, least_y) = (v.acceleration[0], v.least[0]);
            let size = lever.abs();
            let arms = if lever < zero { (right, left) } else { (left, right) };
            let up = h.highest.partition_point(|most| !(size * *most > arms.0 * least_y));
            let down = h.deepest.partition_point(|most| !(size * *most > arms.1 * least_y));
            sample = up.min(down);
            if sample > 0 && y > zero {
                friction = scale.abs() * h.strongest[sample - 1] / y;
            }
        }
        // Whole blocks of gaps at once, without a branch in them.
        while !self.still
            && let Some((h_most, h_least, x)) = block(h, sample)
            && let Some((_, v_least, y)) = block(v, sample.min(v.least.len().saturating_sub(BLOCK)))
        {
            let mut any = false;
            let mut largest = friction;
            for i in 0..BLOCK {
                any |= lifts(h_most[i], h_least[i], v_least[i]);
                let share = scale.abs() * x[i].abs() / y[i];
                let pressed = if y[i] > zero { share } else { zero };
                largest = largest.max(pressed);
            }
            if any {
                break;
            }
            friction = largest;
            sample += BLOCK;
        }
        while !self.still && sample < last {
            let gap = sample.min(v.least.len() - 1);
            if lifts(h.most[sample], h.least[sample], v.least[gap]) {
                break;
            }
            let (x, y) = (scale.abs() * h.acceleration[sample].abs(), v.acceleration[gap]);
            if x > friction * y && y > zero {
                friction = x / y;
            }
            sample += 1;
        }
        let at = sample.min(v.motion.len() - 1);
        let (across, up) = (&h.motion[sample], &v.motion[at]);
        let turned = if scale < zero { -across.z } else { across.z };
        state.motion = Motion {
            u: scale * across.u,
            du: scale * across.du,
            v: up.v,
            dv: up.dv,
            z: turned,
            phi: zero,
            dphi: zero,
        };
        state.max_u = scale.abs() * h.peak[sample];
        state.max_v = v.peak[at];
        if v.lowest[at] < state.min_contact {
            state.min_contact = v.lowest[at];
        }
        state.friction = friction;
        // A sample is a step of the cell or more, of which there are fewer than 2^32.
        state.step = (sample as u32 * cell.substeps).min(cell.steps_forced);
        if state.step >= cell.steps {
            state.status = FINISHED;
        }
    }
}

impl<R: Real> Track<R> {
    fn new(
        plan: &Plan,
        variant: Variant,
        point: &Point,
        direction: Direction,
        record: &[Ground<R>],
    ) -> Track<R> {
        let mut model = plan.model::<R>();
        // No lever arm lifts: the uplift moments (14) are zero.
        (model.height, model.left.arm, model.right.arm) = (R::of(0.0), R::of(0.0), R::of(0.0));
        let (cell, state) = plan.cell::<R>(point);
        let set = CellEquations { variant, model: &model, cell: &cell, record };
        let count = (cell.steps_forced / cell.substeps) as usize + 1;
        let mut track = Track {
            motion: Vec::with_capacity(count),
            acceleration: Vec::with_capacity(count),
            least: Vec::with_capacity(count),
            most: Vec::with_capacity(count),
            peak: Vec::with_capacity(count),
            lowest: Vec::with_capacity(count),
            highest: Vec::new(),
            deepest: Vec::new(),
            strongest: Vec::new(),
        };
        let acceleration = |state: &State<R>| {
            // The last step's end belongs to it.
            let (step, fraction) = match state.step {
                step if step < cell.steps_forced => (step, 0.0),
                _ => (cell.steps_forced - 1, 1.0),
            };
            let corner = pivot(&model, FULL_CONTACT);
            let ground = ground_at(&set, step, R::of(fraction));
            let k = rates(&set, &corner, false, &state.motion, ground);
            if direction == Direction::Horizontal { k.shear } else { k.normal }
        };
        let mut single = Single::new(&set, &state, ());
        let mut state = state;
        let mut now = acceleration(&state);
        let mut lowest = now;
        for sample in 0..count {
            let peak = if direction == Direction::Horizontal { state.max_u } else { state.max_v };
            track.motion.push(state.motion);
            track.acceleration.push(now);
            track.peak.push(peak);
            track.lowest.push(lowest);
            if sample + 1 == count {
                break;
            }
            let (mut least, mut most, mut change) = (now, now, R::of(0.0));
            for _ in 0..cell.substeps {
                single.step();
                state = single.state();
                let next = acceleration(&state);
                change = change.max((next - now).abs());
                if next < least {
                    least = next;
                }
                most = most.max(next);
                now = next;
            }
            if least < lowest {
                lowest = least;
            }
            let slack = change + R::of(CREST) * most.abs().max(least.abs());
            track.least.push(least - slack);
            track.most.push(most + slack);
        }
        let largest = |numbers: &mut dyn Iterator<Item = R>| {
            let mut most = R::of(0.0);
            let so_far = numbers.map(|number| {
                most = most.max(number);
                most
            });
            so_far.collect()
        };
        track.highest = largest(&mut track.most.iter().copied());
        track.deepest = largest(&mut track.least.iter().map(|&least| -least));
        track.strongest = largest(&mut track.acceleration.iter().map(|x| x.abs()));
        track
    }
}

/// A cell of a grid as its integration begins: its point, its numbers, and the state that the full
/// contact it shares, if it does, has taken it to.
#[inline(always)]
pub fn start<R: Real>(
    plan: &Plan,
    grid: &Grid,
    index: usize,
    tracks: Option<&Tracks<R>>,
) -> (Point, Cell<R>, State<R>) {
    let point = grid.point(index);
    let (cell, mut state) = plan.cell::<R>(&point);
    if let Some(tracks) = tracks {
        tracks.begin(index, &point, &cell, &mut state);
    }
    (point, cell, state)
}
