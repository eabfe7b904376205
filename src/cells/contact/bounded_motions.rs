//! Motions in full contact, of which only the bounds of each gap are kept. They are used where no contact force is
//! requested. As many motions are integrated at once as a vector has lanes.

use fearless_simd::Level;

use super::sampling::{Gaps, add, load};
use super::shared_motion::{Direction, MotionSet, SampledMotion};
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Lanes, Shared, each};
use crate::work::vectors::vectorized;

/// Integrates motions on the vectors of a level, no more than it has [lanes](crate::work::vectors::lanes_of).
pub fn sample<R: Real>(set: MotionSet<R>, level: Level) -> Vec<SampledMotion<R>> {
    let zero = R::of(0.0);
    let mut sampled = Vec::new();
    vectorized!(level, zero => sampled = integrate(set, zero));
    sampled
}

#[inline(always)]
fn integrate<V: Vector>(set: MotionSet<V::Element>, zero: V) -> Vec<SampledMotion<V::Element>> {
    let MotionSet { variant, direction, record, starts } = set;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero, ());
    let mut sampled = load(&mut lanes, &set, 1);
    let now = force(&lanes, direction);
    // No extreme of a force is known yet.
    let unknown = Direction::Vertical.no_crest(zero);
    let mut gaps = Gaps::at(now);
    let first = gaps.known(zero, unknown);
    for (lane, sampled) in sampled.iter_mut().enumerate() {
        add(sampled, &lanes, lane, direction, &first);
    }
    while lanes.running() != 0 {
        let ended = if lanes.has_kinks() { lanes.advance() } else { lanes.stand() };
        let through = lanes.between_steps();
        gaps.take(through, force(&lanes, direction));
        // The gaps of a pulse are its steps.
        let over = if variant.recorded { through & lanes.between_segments() } else { through };
        if V::any(over) {
            let known = gaps.known(zero, unknown);
            for lane in each(V::bits(over)) {
                add(&mut sampled[lane], &lanes, lane, direction, &known);
            }
            gaps.begin(over);
        }
        lanes.leave_off(ended);
    }
    let ends = sampled.into_iter().zip(starts);
    ends.map(|(sampled, start)| sampled.filled(start.samples()).finish(false)).collect()
}

/// X or Y in each lane.
#[inline(always)]
fn force<V: Vector>(lanes: &Lanes<V>, direction: Direction) -> V {
    direction.of(lanes.contact())
}
