//! What the two integrators of shared motions have in common: motions on the lanes of a vector, and the values that
//! are kept of each gap between two samples.

use super::shared_motion::{Direction, MotionSet, SLACK, Sample, SampledMotion};
use crate::model::excitation::Cell;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Job, Lanes};
use crate::stepping::log::Listener;
use crate::stepping::state::RUNNING;

/// Assigns each motion of a set to a lane. The result also has the motions, still empty, whose gaps are divided into
/// a given number of parts.
#[inline(always)]
pub(crate) fn load<V: Vector, L: Listener<V>>(
    lanes: &mut Lanes<V, L>,
    set: &MotionSet<V::Element>,
    parts: u32,
) -> Vec<SampledMotion<V::Element>> {
    let mut sampled = Vec::with_capacity(set.starts.len());
    for (number, start) in set.starts.iter().enumerate() {
        sampled.push(SampledMotion::of(start.samples(), parts));
        let cell = Cell { body: number as u32, steps: start.steps(), ..start.cell };
        if start.state.status == RUNNING && cell.steps > 0 {
            lanes.load(number, Job { number, cell, state: start.state });
        }
    }
    sampled
}

/// X or Y of each lane since the begin of its gap.
pub(crate) struct Gaps<V> {
    pub now: V,
    least: V,
    most: V,
    /// The largest change within a step.
    change: V,
}

impl<V: Vector> Gaps<V> {
    /// The values at the start of a gap.
    #[inline(always)]
    pub fn at(now: V) -> Gaps<V> {
        Gaps { now, least: now, most: now, change: now.like(0.0) }
    }

    /// Some lanes have finished a step.
    #[inline(always)]
    pub fn take(&mut self, lanes: V::Mask, next: V) {
        self.change = V::select(lanes, self.change.max((next - self.now).abs()), self.change);
        self.least = V::select(lanes, self.least.min(next), self.least);
        self.most = V::select(lanes, self.most.max(next), self.most);
        self.now = V::select(lanes, next, self.now);
    }

    /// Some lanes begin their next gap.
    #[inline(always)]
    pub fn begin(&mut self, lanes: V::Mask) {
        self.least = V::select(lanes, self.now, self.least);
        self.most = V::select(lanes, self.now, self.most);
        self.change = V::select(lanes, self.change.like(0.0), self.change);
    }

    /// What is known of the gap of each lane, except its crest and the least value so far: bounds that allow for the
    /// values between the ends of steps.
    #[inline(always)]
    pub fn known(&self, crest: V, least_so_far: V) -> Known<V> {
        let Gaps { least, most, change, now } = *self;
        let slack = least.like(SLACK).mul_add(most.abs().max(least.abs()), change);
        Known { now, lower: least - slack, upper: most + slack, crest, least_so_far }
    }
}

/// X or Y at the sample of each lane and in the gap that ends there, as in a [`Sample`].
pub(crate) struct Known<V> {
    now: V,
    lower: V,
    upper: V,
    crest: V,
    least_so_far: V,
}

/// Adds the sample at which a lane is.
#[inline(always)]
pub(crate) fn add<V: Vector, L: Listener<V>>(
    sampled: &mut SampledMotion<V::Element>,
    lanes: &Lanes<V, L>,
    lane: usize,
    direction: Direction,
    known: &Known<V>,
) {
    let (motion, extremes) = (lanes.motion(), lanes.extremes());
    let zero = V::Element::of(0.0);
    let (displacement, velocity, z, bottom, top) = match direction {
        Direction::Horizontal => {
            (motion.u, motion.du, motion.z.lane(lane), zero, extremes.max_u.lane(lane))
        }
        Direction::Vertical => {
            let range = (extremes.least_v.lane(lane), extremes.most_v.lane(lane));
            (motion.v, motion.dv, zero, range.0, range.1)
        }
    };
    sampled.samples.push(Sample {
        displacement: displacement.lane(lane),
        velocity: velocity.lane(lane),
        z,
        acceleration: known.now.lane(lane),
        lower: known.lower.lane(lane),
        upper: known.upper.lane(lane),
        crest: known.crest.lane(lane),
        least_so_far: known.least_so_far.lane(lane),
        bottom,
        top,
    });
}
