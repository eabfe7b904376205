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
use super::tracks::{ACCELERATION, DISPLACEMENT, LEAST, Motions, PEAK, VELOCITY};
use super::tracks::{CREST, LOWEST, QUARTERS_H, QUARTERS_V, TROUGH, VERTICAL_FIELDS};
use super::tracks::{DEEPEST, HIGHEST, HORIZONTAL_FIELDS, HYSTERETIC, MOST, STRONGEST};
use crate::model::CellEquations;
use crate::model::block::{FULL_CONTACT, pivot};
use crate::model::dynamics::{Motion, rates};
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::{Excitation, Grid, Point};
use crate::stepping::extremes::crest;
use crate::stepping::forcing::ground_at;
use crate::stepping::rk4::hermite;
use crate::stepping::single::Single;
use crate::stepping::state::State;

/// Most memory for the motions, bytes; a grid that needs more goes without.
const MOST_MEMORY: usize = 1 << 29;
/// Share of its largest value by which an acceleration may exceed those seen at the ends of steps:
/// 80 steps a period leave 8e-4.
const SLACK: f64 = 2.0e-3;
/// Share of the weight, or of the largest |X|, by which the parabolas through quarters of a gap may miss
/// an extremum there. A motion that is faster is shared by nobody.
const MISSED: f64 = 1.0e-3;

/// A motion in one direction, sample by sample.
struct Track<R> {
    /// At each sample.
    motion: Vec<Motion<R>>,
    /// X or Y of (14) at each sample, m/s^2.
    acceleration: Vec<R>,
    /// Bounds of it from each sample to the next.
    least: Vec<R>,
    most: Vec<R>,
    /// It after one, two and three quarters of each gap.
    quarters: [Vec<R>; 3],
    /// Its largest magnitude (of v its least) in each gap, crests between steps included.
    crest: Vec<R>,
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

impl Direction {
    /// The largest |X| or the least Y in a gap, by parabolas through its quarters.
    fn extremum<R: Real>(self, start: R, [first, mid, last]: [R; 3], end: R) -> R {
        let of = |a: [R; 5], pick: fn(R, R) -> R| {
            let crests = pick(crest(a[0], a[1], a[2]), crest(a[2], a[3], a[4]));
            a.into_iter().fold(crests, pick)
        };
        let values = [start, first, mid, last, end];
        match self {
            Direction::Horizontal => of(values.map(|x| x.abs()), |a, b| a.max(b)),
            Direction::Vertical => of(values, |a, b| a.min(b)),
        }
    }
}

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
        for (quarter, values) in track.quarters.iter().enumerate() {
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
        for (quarter, values) in track.quarters.iter().enumerate() {
            motions.fill(QUARTERS_V + quarter, number, values.iter().copied());
        }
    }
    motions
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
        let (mut cell, state) = plan.cell::<R>(point);
        // X by itself: over g it is the friction asked for where the ground does not move vertically.
        let level: Vec<Ground<R>>;
        let mut record = record;
        if direction == Direction::Horizontal {
            cell.amplitude_v = R::of(0.0);
            level = record.iter().map(|ground| Ground { v: R::of(0.0), ..*ground }).collect();
            record = &level;
        }
        let set = CellEquations { variant, model: &model, cell: &cell, record };
        let count = (cell.steps_forced / cell.substeps) as usize + 1;
        let mut track = Track {
            motion: Vec::with_capacity(count),
            acceleration: Vec::with_capacity(count),
            least: Vec::with_capacity(count),
            most: Vec::with_capacity(count),
            peak: Vec::with_capacity(count),
            lowest: Vec::with_capacity(count),
            quarters: [(); 3].map(|()| Vec::with_capacity(count)),
            crest: Vec::with_capacity(count),
            highest: Vec::new(),
            deepest: Vec::new(),
            strongest: Vec::new(),
        };
        let of = |motion: &Motion<R>, step: u32, fraction: R| {
            let corner = pivot(&model, FULL_CONTACT);
            let k = rates(&set, &corner, false, motion, ground_at(&set, step, fraction));
            (if direction == Direction::Horizontal { k.shear } else { k.normal }, k)
        };
        let acceleration = |state: &State<R>| match state.step {
            step if step < cell.steps_forced => of(&state.motion, step, R::of(0.0)).0,
            // The last step's end belongs to it.
            _ => of(&state.motion, cell.steps_forced - 1, R::of(1.0)).0,
        };
        // Between a step's ends by the cubic through them.
        let between = |before: &State<R>, after: &State<R>, fraction: R| {
            let (y0, y1, h) = (&before.motion, &after.motion, cell.step_forced);
            let k0 = of(y0, before.step, R::of(0.0)).1;
            let k1 = of(y1, before.step, R::of(1.0)).1;
            let at = |x0, slope0, x1, slope1| hermite(x0, h * slope0, x1, h * slope1, fraction);
            let motion = Motion {
                u: at(y0.u, k0.du, y1.u, k1.du),
                du: at(y0.du, k0.ddu, y1.du, k1.ddu),
                v: at(y0.v, k0.dv, y1.v, k1.dv),
                dv: at(y0.dv, k0.ddv, y1.dv, k1.ddv),
                z: at(y0.z, k0.dz, y1.z, k1.dz),
                ..*y0
            };
            of(&motion, before.step, fraction).0
        };
        let mut nobody = ();
        let mut single = Single::new(&set, &state, &mut nobody);
        let mut state = state;
        let mut now = acceleration(&state);
        let mut lowest = now;
        let mut missed = R::of(0.0);
        for sample in 0..count {
            let peak = if direction == Direction::Horizontal { state.max_u } else { state.max_v };
            track.motion.push(state.motion);
            track.acceleration.push(now);
            track.peak.push(peak);
            track.lowest.push(lowest);
            if sample + 1 == count {
                break;
            }
            let start = now;
            let (mut least, mut most, mut change) = (now, now, R::of(0.0));
            single.forget_contact();
            for part in 0..cell.substeps {
                let before = state;
                single.step();
                state = single.state();
                for quarter in 1..=3_u32 {
                    let place = f64::from(quarter) / 4.0 * f64::from(cell.substeps);
                    if place.floor() as u32 == part {
                        let fraction = R::of(place - f64::from(part));
                        let value = between(&before, &state, fraction);
                        track.quarters[quarter as usize - 1].push(value);
                    }
                }
                let next = acceleration(&state);
                change = change.max((next - now).abs());
                if next < least {
                    least = next;
                }
                most = most.max(next);
                now = next;
            }
            let crest = match direction {
                Direction::Horizontal => state.friction * model.gravity,
                Direction::Vertical => state.min_contact,
            };
            track.crest.push(crest);
            let quarters = track.quarters.each_ref().map(|values| values[sample]);
            let by_quarters = direction.extremum(start, quarters, now);
            missed = missed.max((by_quarters - crest).abs());
            if crest < lowest {
                lowest = crest;
            }
            let slack = change + R::of(SLACK) * most.abs().max(least.abs());
            track.least.push(least - slack);
            track.most.push(most + slack);
        }
        let scale = match direction {
            Direction::Horizontal => track.crest.iter().fold(R::of(0.0), |most, &x| most.max(x)),
            Direction::Vertical => model.gravity,
        };
        if missed > R::of(MISSED) * scale {
            // Every cell may lift in every gap, and looks for itself.
            let beyond = R::of(f64::from(f32::MAX));
            track.least.fill(-beyond);
            track.most.fill(beyond);
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
        track.strongest = largest(&mut track.crest.iter().copied());
        track
    }
}
