//! What the makers of shared motions have in common: motions on the lanes of a vector, and what is kept of each gap
//! between two samples.

use super::shared_motion::{Direction, MotionBatch, SLACK, SampledMotion, samples};
use crate::model::excitation::Cell;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Job, Lanes};
use crate::stepping::log::Listener;
use crate::stepping::state::RUNNING;

/// Puts each motion of a batch on a lane, up to the end of the excitation; the motions, nothing in them, whose gaps are
/// kept in so many parts.
#[inline(always)]
pub(super) fn load<V: Vector, L: Listener<V>>(
    lanes: &mut Lanes<V, L>,
    batch: &MotionBatch<V::Element>,
    parts: u32,
) -> Vec<SampledMotion<V::Element>> {
    let mut sampled = Vec::with_capacity(batch.starts.len());
    for (number, start) in batch.starts.iter().enumerate() {
        sampled.push(SampledMotion::of(samples(&start.cell), parts));
        let cell = Cell { body: number as u32, steps: start.cell.steps_forced, ..start.cell };
        if start.state.status == RUNNING && cell.steps > 0 {
            lanes.load(number, Job { number, cell, state: start.state });
        }
    }
    sampled
}

/// X or Y of each lane since the gap in which it is began.
pub(super) struct Gaps<V> {
    pub now: V,
    least: V,
    most: V,
    /// The largest change in a step.
    change: V,
}

impl<V: Vector> Gaps<V> {
    /// At the start of a gap.
    #[inline(always)]
    pub fn at(now: V) -> Gaps<V> {
        Gaps { now, least: now, most: now, change: now.like(0.0) }
    }

    /// Some lanes have taken a step.
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

    /// The least and the largest value in each lane's gap, with what may lie between the ends of steps.
    #[inline(always)]
    pub fn bounds(&self) -> [V; 2] {
        let Gaps { least, most, change, .. } = *self;
        let slack = least.like(SLACK).mul_add(most.abs().max(least.abs()), change);
        [least - slack, most + slack]
    }
}

/// Adds the sample that a lane is at: X or Y there, and its least value so far.
#[inline(always)]
pub(super) fn add<V: Vector, L: Listener<V>>(
    sampled: &mut SampledMotion<V::Element>,
    lanes: &Lanes<V, L>,
    lane: usize,
    direction: Direction,
    [now, lowest]: [V::Element; 2],
) {
    let extremes = lanes.extremes();
    let (bottom, top) = match direction {
        Direction::Horizontal => (V::Element::of(0.0), extremes.max_u.lane(lane)),
        Direction::Vertical => (extremes.least_v.lane(lane), extremes.most_v.lane(lane)),
    };
    sampled.motion.push(lanes.motion().map(|number| number.lane(lane)));
    sampled.acceleration.push(now);
    sampled.bottom.push(bottom);
    sampled.top.push(top);
    sampled.lowest.push(lowest);
}
