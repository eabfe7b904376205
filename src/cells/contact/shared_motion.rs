//! A motion in full contact, sample by sample, with the values that cells need that share it: see
//! [`full_contact`](super::full_contact).

use crate::cells::plan::Plan;
use crate::model::block::Model;
use crate::model::dynamics::Contact;
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::number::Number;
use crate::model::real::Real;
use crate::scene::Case;
use crate::stepping::extremes::{bend, crest};
use crate::stepping::state::State;

/// The share of its largest value by which an acceleration may exceed its values at the ends of steps: at 64 steps
/// per period it is at most 1.2e-3.
pub(crate) const SLACK: f64 = 2.0e-3;
/// The share of the weight, or of the largest |X|, by which the parabolas through parts of a gap may miss an extremum
/// there. A faster motion is not shared.
const MISSED: f64 = 5.0e-4;

/// A motion in one direction at a sample, and in the gap that ends there.
#[derive(Clone, Copy, PartialEq)]
pub struct Sample<R> {
    /// u or v, m.
    pub displacement: R,
    /// Its rate, m/s.
    pub velocity: R,
    /// z of u.
    pub z: R,
    /// X or Y of (14), m/s^2.
    pub acceleration: R,
    /// Bounds of the acceleration in the gap.
    pub lower: R,
    pub upper: R,
    /// Its largest magnitude (for v its least value) in the gap, crests between steps included.
    pub crest: R,
    /// Least of the acceleration so far.
    pub least_so_far: R,
    /// Least v so far, m; zero for u.
    pub bottom: R,
    /// Largest |u|, or largest v, so far, m.
    pub top: R,
}

/// A motion in one direction, sample by sample.
pub struct SampledMotion<R> {
    /// The samples. No gap ends at the first.
    pub samples: Vec<Sample<R>>,
    /// The acceleration after each part of a gap: a quarter of X, an eighth of Y.
    pub inside: Vec<Vec<R>>,
    /// Up to and with each gap: the largest upper bound, the largest negative of the lower bound, and the largest
    /// magnitude of the acceleration.
    pub upper_so_far: Vec<R>,
    pub minus_lower_so_far: Vec<R>,
    pub magnitude_so_far: Vec<R>,
}

/// Which of the two directions a motion is in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    Horizontal,
    Vertical,
}

impl Direction {
    /// X or Y of this direction.
    #[inline(always)]
    pub(crate) fn of<R>(self, contact: Contact<R>) -> R {
        match self {
            Direction::Horizontal => contact.shear,
            Direction::Vertical => contact.normal,
        }
    }

    /// The number of parts of a gap.
    pub(crate) fn parts(self) -> u32 {
        match self {
            Direction::Horizontal => 4,
            Direction::Vertical => 8,
        }
    }

    /// The error of the parabolas through parts of gaps that is allowed, m/s^2.
    pub(crate) fn allowed<R: Real>(self, sampled: &SampledMotion<R>, gravity: R) -> R {
        R::of(MISSED)
            * match self {
                Direction::Horizontal => {
                    sampled.gaps().fold(R::of(0.0), |most, gap| most.max(gap.crest))
                }
                Direction::Vertical => gravity,
            }
    }

    /// The larger of the value so far and the largest |X|, or the lesser of the value so far and the least Y, on the
    /// parabolas through the starts, middles and ends of the spans of some lanes.
    #[inline(always)]
    pub(crate) fn crest<N: Number>(
        self,
        lanes: N::Mask,
        so_far: N,
        [start, mid, end]: [N; 3],
    ) -> N {
        // A parabola exceeds its values by no more than its curvature allows: most spans need no division.
        match self {
            Direction::Horizontal => {
                let (start, mid, end) = (start.abs(), mid.abs(), end.abs());
                let most = start.max(mid).max(end);
                let so_far = N::select(lanes, so_far.max(most), so_far);
                let higher = lanes & (most + bend(start, mid, end)).gt(so_far);
                if !N::any(higher) {
                    return so_far;
                }
                N::select(higher, so_far.max(crest(start, mid, end)), so_far)
            }
            Direction::Vertical => {
                let least = start.min(mid).min(end);
                let so_far = N::select(lanes, so_far.min(least), so_far);
                let lower = lanes & so_far.gt(least - bend(start, mid, end));
                if !N::any(lower) {
                    return so_far;
                }
                N::select(lower, so_far.min(crest(start, mid, end)), so_far)
            }
        }
    }

    /// The value before the first span.
    #[inline(always)]
    pub(crate) fn no_crest<N: Number>(self, like: N) -> N {
        match self {
            Direction::Horizontal => like.like(0.0),
            Direction::Vertical => like.like(f64::from(f32::MAX)),
        }
    }
}

/// The data with which the integration of a motion begins.
#[derive(Clone, Copy)]
pub struct Start<R> {
    /// A body whose uplift moments (14) are zero, because it has no lever arm.
    pub model: Model<R>,
    /// The numbers of a cell that shares the motion.
    pub cell: Cell<R>,
    /// The state at rest.
    pub state: State<R>,
    /// Steps after the excitation.
    pub after: u32,
}

impl<R: Real> Start<R> {
    /// The start of the motion of a case in one direction, in the steps of a plan, with at most so many steps after
    /// the excitation.
    pub fn of(plan: &Plan, case: &Case, direction: Direction, after: u32) -> Start<R> {
        let mut model = plan.model::<R>(case);
        (model.height, model.left.arm, model.right.arm) = (R::of(0.0), R::of(0.0), R::of(0.0));
        let (mut cell, state) = plan.cell::<R>(case);
        if direction == Direction::Horizontal {
            // X by itself: divided by g it is the friction demand where the ground does not move vertically.
            cell.amplitude_v = R::of(0.0);
        }
        let after = after.min(cell.steps - cell.steps_forced);
        Start { model, cell, state, after }
    }

    /// Steps of the motion.
    pub fn steps(&self) -> u32 {
        self.cell.steps_forced + self.after
    }

    /// The number of its samples, which end its gaps.
    pub fn samples(&self) -> usize {
        (self.steps() / self.cell.substeps) as usize + 1
    }
}

/// Motions of one direction, under one record, that are integrated together.
#[derive(Clone, Copy)]
pub struct MotionSet<'a, R> {
    /// The variant that has this direction alone.
    pub variant: Variant,
    /// The direction.
    pub direction: Direction,
    /// The record.
    pub record: &'a [Ground<R>],
    /// The starts of the motions.
    pub starts: &'a [Start<R>],
}

/// A bound beyond any acceleration, m/s^2.
fn beyond<R: Real>() -> R {
    R::of(f64::from(f32::MAX))
}

impl<R: Real> SampledMotion<R> {
    /// A motion of a given number of samples, still empty.
    pub(crate) fn of(count: usize, parts: u32) -> SampledMotion<R> {
        SampledMotion {
            samples: Vec::with_capacity(count),
            inside: (1..parts).map(|_| Vec::with_capacity(count)).collect(),
            upper_so_far: Vec::new(),
            minus_lower_so_far: Vec::new(),
            magnitude_so_far: Vec::new(),
        }
    }

    /// The gaps, each with the sample that ends it.
    pub(crate) fn gaps(&self) -> impl Iterator<Item = &Sample<R>> {
        self.samples.iter().skip(1)
    }

    /// The same with the full number of samples. A motion that exceeds the range of the number type ends early: cells
    /// that share it integrate by themselves.
    pub(crate) fn filled(mut self, count: usize) -> SampledMotion<R> {
        if let Some(&last) = self.samples.last()
            && self.samples.len() < count
        {
            self.samples.resize(count, last);
            self.bound_nothing();
        }
        self
    }

    /// With these bounds every cell may lift in every gap, and so integrates by itself.
    fn bound_nothing(&mut self) {
        for sample in &mut self.samples {
            (sample.lower, sample.upper) = (-beyond::<R>(), beyond());
        }
    }

    /// Computes what depends on all gaps; `missed`: the parts of gaps do not describe the crests.
    pub(crate) fn finish(mut self, missed: bool) -> SampledMotion<R> {
        if missed {
            self.bound_nothing();
        }
        let largest = |of: &dyn Fn(&Sample<R>) -> R| {
            let mut most = -beyond::<R>();
            let so_far = self.gaps().map(|gap| {
                most = most.max(of(gap));
                most
            });
            so_far.collect()
        };
        let upper_so_far = largest(&|gap| gap.upper);
        let minus_lower_so_far = largest(&|gap| -gap.lower);
        let magnitude_so_far = largest(&|gap| gap.crest);
        SampledMotion { upper_so_far, minus_lower_so_far, magnitude_so_far, ..self }
    }
}
