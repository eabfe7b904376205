//! Motions in full contact of which only bounds are kept of each gap: where no contact force is asked for, as many
//! motions at once as a vector has lanes.

use fearless_simd::{Level, Simd};

use super::shared_motion::{Direction, MotionBatch, SLACK, SampledMotion, Start, samples};
use super::vectors::vectorized;
use crate::model::excitation::Cell;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Job, Lanes, Shared};
use crate::stepping::log::Listener;
use crate::stepping::state::RUNNING;

/// Motions that are made at once: as many as the lanes of a vector.
pub fn at_once<R>() -> usize {
    64 / size_of::<R>()
}

/// Integrates no more motions than [`at_once`] on the vectors of a level.
pub fn sample<R: Real>(batch: MotionBatch<R>, level: Level) -> Vec<SampledMotion<R>> {
    let zero = R::of(0.0);
    let mut sampled = Vec::new();
    vectorized!(level, simd => sampled = integrate(batch, zero.lanes(simd)));
    sampled
}

/// X or Y of each lane since the gap in which it is began.
pub(super) struct Gaps<V> {
    pub now: V,
    pub least: V,
    pub most: V,
    /// The largest change in a step.
    pub change: V,
}

#[inline(always)]
fn integrate<V: Vector>(batch: MotionBatch<V::Element>, zero: V) -> Vec<SampledMotion<V::Element>> {
    let MotionBatch { variant, direction, record, starts } = batch;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero, ());
    let mut sampled = Vec::with_capacity(starts.len());
    for (number, Start { cell, state, .. }) in starts.iter().enumerate() {
        sampled.push(SampledMotion::of(samples(cell), 1));
        // It ends with the excitation.
        let cell = Cell { body: number as u32, steps: cell.steps_forced, ..*cell };
        if state.status == RUNNING && cell.steps > 0 {
            lanes.load(number, Job { number, cell, state: *state });
        }
    }
    let now = force(&lanes, direction);
    // No force is on record.
    let unknown = Direction::Vertical.no_crest(zero);
    let mut gaps = Gaps { now, least: now, most: now, change: zero };
    for (lane, sampled) in sampled.iter_mut().enumerate() {
        add(sampled, &lanes, lane, direction, [now.lane(lane), unknown.lane(lane)]);
    }
    while lanes.running() != 0 {
        let ended = lanes.advance();
        let through = lanes.between_steps();
        let next = force(&lanes, direction);
        gaps.change = V::select(through, gaps.change.max((next - gaps.now).abs()), gaps.change);
        gaps.least = V::select(through, gaps.least.min(next), gaps.least);
        gaps.most = V::select(through, gaps.most.max(next), gaps.most);
        gaps.now = V::select(through, next, gaps.now);
        // The gaps of a pulse are its steps.
        let over = if variant.recorded { through & lanes.between_segments() } else { through };
        if V::any(over) {
            let [least, most] = bounds(&gaps);
            for (lane, sampled) in sampled.iter_mut().enumerate() {
                if V::bits(over) >> lane & 1 == 1 {
                    sampled.least.push(least.lane(lane));
                    sampled.most.push(most.lane(lane));
                    add(
                        sampled,
                        &lanes,
                        lane,
                        direction,
                        [gaps.now.lane(lane), unknown.lane(lane)],
                    );
                }
            }
            gaps.least = V::select(over, gaps.now, gaps.least);
            gaps.most = V::select(over, gaps.now, gaps.most);
            gaps.change = V::select(over, zero, gaps.change);
        }
        lanes.leave_off(ended);
    }
    let ends = sampled.into_iter().zip(starts);
    ends.map(|(sampled, start)| sampled.filled(samples(&start.cell)).finish(false)).collect()
}

/// X or Y where each lane is.
#[inline(always)]
fn force<V: Vector>(lanes: &Lanes<V>, direction: Direction) -> V {
    direction.of(lanes.contact())
}

/// The least and the largest value in each lane's gap, with what may lie between the ends of steps.
#[inline(always)]
pub(super) fn bounds<V: Vector>(gaps: &Gaps<V>) -> [V; 2] {
    let Gaps { least, most, change, .. } = *gaps;
    let slack = least.like(SLACK).mul_add(most.abs().max(least.abs()), change);
    [least - slack, most + slack]
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
