//! Motions in full contact, of which only the bounds of each gap are kept. They are used where no contact force is
//! requested. As many motions are integrated at once as a vector has lanes.

use fearless_simd::Level;

use super::motions::Slots;
use super::sampling::{Gaps, load};
use super::shared_motion::MotionSet;
use super::written_motions::WrittenMotions;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::{Lanes, Shared};
use crate::stepping::spans::Direction;
use crate::work::vectors::vectorized;

/// Integrates motions on the vectors of a level, no more than it has [lanes](crate::work::vectors::lanes_of), and writes
/// them to their slots.
pub fn integrate<R: Real>(set: MotionSet<R>, slots: &mut [Slots<R>], level: Level) {
    let zero = R::of(0.0);
    vectorized!(level, zero => integrate_lanes(set, slots, zero));
}

#[inline(always)]
fn integrate_lanes<V: Vector>(
    set: MotionSet<V::Element>,
    slots: &mut [Slots<V::Element>],
    zero: V,
) {
    let MotionSet { variant, direction, record, starts } = set;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero);
    load(&mut lanes, &set);
    let mut gaps = Gaps::at(force(&lanes, direction));
    let first = gaps.end(zero.mask(0), &lanes, direction);
    let mut written = WrittenMotions::begin(slots, (direction, false), &first);
    while lanes.running() != 0 {
        let ended = if lanes.has_kinks() { lanes.advance() } else { lanes.stand() };
        let through = lanes.between_steps();
        gaps.take(through, force(&lanes, direction));
        // The gaps of a pulse are its steps.
        let over = if variant.recorded { through & lanes.between_segments() } else { through };
        if V::any(over) {
            let row = gaps.end(over, &lanes, direction);
            written.add(V::bits(over), &row);
            gaps.begin(over);
        }
        lanes.leave_off(ended);
    }
    written.end(|_, _| false);
}

/// X or Y in each lane.
#[inline(always)]
fn force<V: Vector>(lanes: &Lanes<V>, direction: Direction) -> V {
    direction.of(lanes.contact())
}
