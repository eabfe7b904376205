//! A motion in full contact, sample by sample, with what cells that share it ask of it: see
//! [`full_contact`](super::full_contact).

use std::cell;

use super::plan::Plan;
use crate::model::CellEquations;
use crate::model::block::{FULL_CONTACT, Model, pivot};
use crate::model::dynamics::{Contact, rates};
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::motion::Motion;
use crate::model::real::Real;
use crate::scene::Case;
use crate::stepping::extremes::{bend, crest, parabola};
use crate::stepping::forcing::ground_at;
use crate::stepping::log::Log;
use crate::stepping::rk4::hermite;
use crate::stepping::single::Single;
use crate::stepping::standing::Standing;
use crate::stepping::state::State;

/// Share of its largest value by which an acceleration may exceed its values at the ends of steps:
/// 80 steps a period leave 8e-4.
pub(super) const SLACK: f64 = 2.0e-3;
/// Share of the weight, or of the largest |X|, by which the parabolas through parts of a gap may miss an
/// extremum there. A motion that is faster is shared by nobody.
const MISSED: f64 = 5.0e-4;
/// Steps of a gap from which on eighths of it are taken from them; with fewer, its quarters tell them.
const STEPS_FOR_EIGHTHS: u32 = 8;

/// A motion in one direction, sample by sample.
pub struct SampledMotion<R> {
    /// At each sample.
    pub motion: Vec<Motion<R>>,
    /// X or Y of (14) at each sample, m/s^2.
    pub acceleration: Vec<R>,
    /// Bounds of it from each sample to the next.
    pub least: Vec<R>,
    pub most: Vec<R>,
    /// It after each part of a gap: a quarter of X, an eighth of Y.
    pub inside: Vec<Vec<R>>,
    /// Its largest magnitude (of v its least) in each gap, crests between steps included.
    pub crest: Vec<R>,
    /// Least v up to each sample, m; of u zeros.
    pub bottom: Vec<R>,
    /// Largest |u|, or largest v, up to each sample, m.
    pub top: Vec<R>,
    /// Least of the acceleration up to each sample.
    pub lowest: Vec<R>,
    /// Largest upper bound, largest lower bound turned about, and largest magnitude of the
    /// acceleration, up to and with each gap.
    pub highest: Vec<R>,
    pub deepest: Vec<R>,
    pub strongest: Vec<R>,
}

/// Which of the two directions a motion is in.
#[derive(Clone, Copy, PartialEq)]
pub enum Direction {
    Horizontal,
    Vertical,
}

impl Direction {
    /// X or Y.
    pub(super) fn of<R>(self, contact: Contact<R>) -> R {
        match self {
            Direction::Horizontal => contact.shear,
            Direction::Vertical => contact.normal,
        }
    }

    /// Parts that a gap is kept in.
    fn parts(self) -> u32 {
        match self {
            Direction::Horizontal => 4,
            Direction::Vertical => 8,
        }
    }

    /// What parabolas through parts of gaps may miss, m/s^2.
    fn allowed<R: Real>(self, sampled: &SampledMotion<R>, gravity: R) -> R {
        R::of(MISSED)
            * match self {
                Direction::Horizontal => {
                    sampled.crest.iter().fold(R::of(0.0), |most, &x| most.max(x))
                }
                Direction::Vertical => gravity,
            }
    }

    /// The largest |X| or the least Y in a gap, by parabolas through its parts' ends.
    fn extremum<R: Real>(self, values: &[R]) -> R {
        let spans = values.windows(3).step_by(2).map(|span| [span[0], span[1], span[2]]);
        spans.fold(self.no_crest(), |so_far, span| self.crest(so_far, span))
    }

    /// The larger of the one so far and the largest |X|, or the lesser and the least Y, on the parabola
    /// through a span's start, middle and end.
    #[inline(always)]
    fn crest<R: Real>(self, so_far: R, [start, mid, end]: [R; 3]) -> R {
        // A parabola goes beyond its values by no more than its bend: most spans need no division.
        match self {
            Direction::Horizontal => {
                let [start, mid, end] = [start.abs(), mid.abs(), end.abs()];
                let most = start.max(mid).max(end);
                let so_far = so_far.max(most);
                let higher = most + bend(start, mid, end) > so_far;
                if higher { so_far.max(crest(start, mid, end)) } else { so_far }
            }
            Direction::Vertical => {
                let least = start.min(mid).min(end);
                let so_far = so_far.min(least);
                let lower = least - bend(start, mid, end) < so_far;
                if lower { so_far.min(crest(start, mid, end)) } else { so_far }
            }
        }
    }

    /// That of no span at all.
    pub(super) fn no_crest<R: Real>(self) -> R {
        match self {
            Direction::Horizontal => R::of(0.0),
            Direction::Vertical => R::of(f64::from(f32::MAX)),
        }
    }
}

/// Where a motion begins.
#[derive(Clone, Copy)]
pub struct Start<R> {
    /// A body that no lever arm lifts: its uplift moments (14) are zero.
    pub model: Model<R>,
    /// The numbers of a cell that shares the motion.
    pub cell: Cell<R>,
    /// The state at rest.
    pub state: State<R>,
}

impl<R: Real> Start<R> {
    /// That of a motion that a case has in one direction, in the steps of a plan.
    pub fn of(plan: &Plan, case: &Case, direction: Direction) -> Start<R> {
        let mut model = plan.model::<R>(case);
        (model.height, model.left.arm, model.right.arm) = (R::of(0.0), R::of(0.0), R::of(0.0));
        let (mut cell, state) = plan.cell::<R>(case);
        if direction == Direction::Horizontal {
            // X by itself: over g it is the friction asked for where the ground does not move vertically.
            cell.amplitude_v = R::of(0.0);
        }
        Start { model, cell, state }
    }
}

/// Samples of a cell's motion in full contact: the ends of its gaps.
pub fn samples<R>(cell: &Cell<R>) -> usize {
    (cell.steps_forced / cell.substeps) as usize + 1
}

/// A bound beyond any acceleration, m/s^2.
fn beyond<R: Real>() -> R {
    R::of(f64::from(f32::MAX))
}

/// X or Y, m/s^2, in the steps of a gap so far.
#[derive(Clone, Copy)]
struct GapForces<R> {
    /// Spans of the last step: more than one where z or u' changed its sign in it.
    spans: u32,
    /// In the middle of the last span and at its end.
    mid: R,
    end: R,
    /// The largest magnitude, or the least, of all spans.
    crest: R,
}

/// Integrates a motion, a step at a time.
trait Integrator<R> {
    /// Takes a step; the forces in the steps since the gap began.
    fn step(&mut self) -> GapForces<R>;
    /// The motion; of v the least and the largest so far, of u zero and the largest magnitude.
    fn place(&mut self) -> (Motion<R>, [R; 2]);
    /// Begins a gap.
    fn begin_gap(&mut self);
}

/// The forces of a gap with those of one more span.
#[inline(always)]
fn add_span<R: Real>(
    forces: GapForces<R>,
    direction: Direction,
    contacts: [Contact<R>; 3],
) -> GapForces<R> {
    let span = contacts.map(|contact| direction.of(contact));
    let [_, mid, end] = span;
    GapForces { spans: forces.spans + 1, mid, end, crest: direction.crest(forces.crest, span) }
}

/// The forces of a gap before its first span.
fn no_forces<R: Real>(direction: Direction) -> GapForces<R> {
    let zero = R::of(0.0);
    GapForces { spans: 0, mid: zero, end: zero, crest: direction.no_crest() }
}

/// A base that does not yield.
struct Smooth<'a, R: Real> {
    standing: Standing<'a, R>,
    direction: Direction,
    forces: GapForces<R>,
}

impl<R: Real> Integrator<R> for Smooth<'_, R> {
    #[inline(always)]
    fn step(&mut self) -> GapForces<R> {
        self.forces.spans = 0;
        self.forces = add_span(self.forces, self.direction, self.standing.step());
        self.forces
    }

    fn place(&mut self) -> (Motion<R>, [R; 2]) {
        let Standing { motion, max_u, range_v, .. } = self.standing;
        let range_u = [R::of(0.0), max_u];
        (motion, if self.direction == Direction::Horizontal { range_u } else { range_v })
    }

    fn begin_gap(&mut self) {
        self.forces = no_forces(self.direction);
    }
}

/// A base that yields: its steps are cut at the kinks of the Bouc-Wen law.
struct Yielding<'a, R: Real> {
    single: Single<'a, R>,
    forces: &'a cell::Cell<GapForces<R>>,
}

/// Adds the spans of a yielding base's steps to the forces of the gap.
struct ForceListener<'a, R>(&'a cell::Cell<GapForces<R>>);

impl<R: Real> Log<R> for ForceListener<'_, R> {
    fn switched(&mut self, _: u32, _: R, _: &State<R>) {}

    fn moved(&mut self, contacts: [Contact<R>; 3]) {
        self.0.set(add_span(self.0.get(), Direction::Horizontal, contacts));
    }
}

impl<R: Real> Integrator<R> for Yielding<'_, R> {
    fn step(&mut self) -> GapForces<R> {
        self.forces.set(GapForces { spans: 0, ..self.forces.get() });
        self.single.step();
        self.forces.get()
    }

    fn place(&mut self) -> (Motion<R>, [R; 2]) {
        let state = self.single.state();
        (state.motion, [R::of(0.0), state.max_u])
    }

    fn begin_gap(&mut self) {
        self.forces.set(no_forces(Direction::Horizontal));
    }
}

/// X or Y at a fraction of a step, by the cubic through its ends.
fn between<R: Real>(
    set: &CellEquations<R>,
    step: u32,
    (y0, y1): (&Motion<R>, &Motion<R>),
    fraction: R,
) -> Contact<R> {
    let corner = pivot(set.model, FULL_CONTACT);
    let of = |motion: &Motion<R>, fraction: R| {
        rates(set, &corner, false, motion, ground_at(set, step, fraction))
    };
    let h = set.cell.step_forced;
    let (k0, k1) = (of(y0, R::of(0.0)), of(y1, R::of(1.0)));
    let at = |x0, slope0, x1, slope1| hermite(x0, h * slope0, x1, h * slope1, fraction);
    let motion = Motion {
        u: at(y0.u, k0.du, y1.u, k1.du),
        du: at(y0.du, k0.ddu, y1.du, k1.ddu),
        v: at(y0.v, k0.dv, y1.v, k1.dv),
        dv: at(y0.dv, k0.ddv, y1.dv, k1.ddv),
        z: at(y0.z, k0.dz, y1.z, k1.dz),
        ..*y0
    };
    of(&motion, fraction).contact()
}

impl<R: Real> SampledMotion<R> {
    /// A motion with its forces inside gaps, by the `variant` that has its direction alone.
    pub fn with_forces(
        start: &Start<R>,
        variant: Variant,
        direction: Direction,
        record: &[Ground<R>],
    ) -> SampledMotion<R> {
        let Start { model, cell, state } = start;
        let set = CellEquations { variant, model, cell, record };
        let first = ground_at(&set, 0, R::of(0.0));
        let k = rates(&set, &pivot(model, FULL_CONTACT), false, &state.motion, first);
        let now = direction.of(k.contact());
        if set.variant.kinks {
            let forces = cell::Cell::new(no_forces(direction));
            let mut listener = ForceListener(&forces);
            let single = Single::new(&set, state, &mut listener);
            let mut yielding = Yielding { single, forces: &forces };
            SampledMotion::integrate(&set, direction, now, &mut yielding)
        } else {
            let standing = Standing::new(&set, state);
            let forces = no_forces(direction);
            let mut smooth = Smooth { standing, direction, forces };
            SampledMotion::integrate(&set, direction, now, &mut smooth)
        }
    }

    /// A motion of so many samples, nothing in it.
    pub(super) fn of(count: usize, parts: u32) -> SampledMotion<R> {
        SampledMotion {
            motion: Vec::with_capacity(count),
            acceleration: Vec::with_capacity(count),
            least: Vec::with_capacity(count),
            most: Vec::with_capacity(count),
            bottom: Vec::with_capacity(count),
            top: Vec::with_capacity(count),
            lowest: Vec::with_capacity(count),
            inside: (1..parts).map(|_| Vec::with_capacity(count)).collect(),
            crest: Vec::with_capacity(count),
            highest: Vec::new(),
            deepest: Vec::new(),
            strongest: Vec::new(),
        }
    }

    /// The same with as many samples as it should have. A motion that the number type does not hold ends early: cells
    /// that share it integrate by themselves.
    pub(super) fn filled(mut self, count: usize) -> SampledMotion<R> {
        let Some(last) = self.motion.last().copied() else { return self };
        if self.motion.len() == count {
            return self;
        }
        self.motion.resize(count, last);
        let ends = [&mut self.acceleration, &mut self.bottom, &mut self.top, &mut self.lowest];
        for values in ends {
            let last = values.last().copied().unwrap_or(R::of(0.0));
            values.resize(count, last);
        }
        self.least = vec![-beyond::<R>(); count - 1];
        self.most = vec![beyond(); count - 1];
        self
    }

    /// Adds the bounds of a gap: the least and the largest value at ends of steps, and the largest change in a step.
    fn bound(&mut self, least: R, most: R, change: R) {
        let slack = change + R::of(SLACK) * most.abs().max(least.abs());
        self.least.push(least - slack);
        self.most.push(most + slack);
    }

    /// Integrates through all gaps from a start where X or Y is `now`.
    fn integrate(
        set: &CellEquations<R>,
        direction: Direction,
        mut now: R,
        integrator: &mut impl Integrator<R>,
    ) -> SampledMotion<R> {
        let cell = set.cell;
        let count = samples(cell);
        let parts = direction.parts();
        let mut sampled = SampledMotion::of(count, parts);
        // With few steps to a gap every other part is told by those beside it.
        let apart = if cell.substeps < STEPS_FOR_EIGHTHS { parts / 4 } else { 1 };
        let mut values = vec![R::of(0.0); parts as usize + 1];
        // A block that lifts at once, at a jump, has no forces on record.
        let (mut lowest, mut missed) = (Direction::Vertical.no_crest(), R::of(0.0));
        for sample in 0..count {
            let (mut motion, [bottom, top]) = integrator.place();
            sampled.motion.push(motion);
            sampled.acceleration.push(now);
            sampled.bottom.push(bottom);
            sampled.top.push(top);
            sampled.lowest.push(lowest);
            if sample + 1 == count {
                break;
            }
            values[0] = now;
            let (mut least, mut most, mut change) = (now, now, R::of(0.0));
            let (mut part, mut crest) = (apart, now);
            integrator.begin_gap();
            for step in 0..cell.substeps {
                // A part's end that is in this step, by how many parts of the step.
                let in_step = |part: u32| part * cell.substeps - parts * step;
                if step > 0 && part < parts && in_step(part) < parts {
                    motion = integrator.place().0;
                }
                let GapForces { spans, mid, end: next, crest: so_far } = integrator.step();
                while part < parts && in_step(part) < parts {
                    values[part as usize] = match in_step(part) {
                        0 => now,
                        half if 2 * half == parts && spans == 1 => mid,
                        some => {
                            let number = sample as u32 * cell.substeps + step;
                            let fraction = R::of(f64::from(some) / f64::from(parts));
                            let ends = (&motion, &integrator.place().0);
                            direction.of(between(set, number, ends, fraction))
                        }
                    };
                    part += apart;
                }
                crest = so_far;
                change = change.max((next - now).abs());
                least = least.min(next);
                most = most.max(next);
                now = next;
            }
            values[parts as usize] = now;
            if apart == 2 {
                for half in [0, 4] {
                    let (start, mid, end) = (values[half], values[half + 2], values[half + 4]);
                    values[half + 1] = parabola(start, mid, end, R::of(0.25));
                    values[half + 3] = parabola(start, mid, end, R::of(0.75));
                }
            }
            for (kept, value) in sampled.inside.iter_mut().zip(&values[1..]) {
                kept.push(*value);
            }
            sampled.crest.push(crest);
            missed = missed.max((direction.extremum(&values) - crest).abs());
            if crest < lowest {
                lowest = crest;
            }
            sampled.bound(least, most, change);
        }
        let missed = missed > direction.allowed(&sampled, set.model.gravity);
        sampled.finish(missed)
    }

    /// What is known once all gaps are; `missed`: parts of gaps do not tell the crests.
    pub(super) fn finish(mut self, missed: bool) -> SampledMotion<R> {
        if missed {
            // With these bounds every cell may lift in every gap, and integrates by itself.
            let beyond = beyond::<R>();
            self.least.fill(-beyond);
            self.most.fill(beyond);
        }
        let largest = |numbers: &mut dyn Iterator<Item = R>| {
            let mut most = R::of(0.0);
            let so_far = numbers.map(|number| {
                most = most.max(number);
                most
            });
            so_far.collect()
        };
        self.highest = largest(&mut self.most.iter().copied());
        self.deepest = largest(&mut self.least.iter().map(|&least| -least));
        self.strongest = largest(&mut self.crest.iter().copied());
        self
    }
}
