//! The friction demand of full contact, from the motions that cells share. Twin of `shaders/shared_friction.wgsl`.

use bytemuck::Zeroable;

use super::motions::{ACCELERATION, LEAST, LEAST_SO_FAR, MAGNITUDE, MAGNITUDE_SO_FAR, MotionPair};
use crate::model::CellEquations;
use crate::model::dynamics::{Contact, rates};
use crate::model::isolation::support;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};
use crate::stepping::forcing::Forcing;
use crate::stepping::rk4::rk4;
use crate::stepping::state::State;

/// The number of gaps before a sample that are searched as vectors: those in which u and v both have numbers, if they
/// fill a vector. The others are searched one by one.
fn in_vectors<V: Vector>(sample: usize, last_v: usize) -> usize {
    let both = sample.min(last_v);
    if both < V::LANES { 0 } else { both }
}

/// The friction demand at the samples before a given one, if it is known at some. The motion of a block grows until
/// the block lifts, so the search goes backwards from the last sample, until the largest |X| so far over the least Y
/// so far is not larger any more.
#[inline(always)]
pub(crate) fn at_samples<V: Vector>(
    motions: &MotionPair<V::Element>,
    size: V::Element,
    sample: usize,
    known: V::Element,
    zero: V,
) -> V::Element {
    let (h, v) = (motions.across, motions.up);
    let last_v = v.length - 1;
    let (x, y) = (h.field(ACCELERATION), v.field(ACCELERATION));
    let (magnitude_so_far, least_so_far) = (h.field(MAGNITUDE_SO_FAR), v.field(LEAST_SO_FAR));
    let sizes = zero.like(size.to_f64());
    // The largest value in each lane.
    let mut frictions = zero;
    let mut before = in_vectors::<V>(sample, last_v);
    let mut friction = known;
    for gap in before..sample {
        let y = y[v.gap(gap)];
        friction = friction.max(share(size, x[gap], y));
    }
    frictions.put(0, friction);
    while before > 0 {
        let limit = zero.like((size * magnitude_so_far[before - 1]).to_f64());
        if V::any((frictions * zero.like(least_so_far[before].to_f64())).ge(limit)) {
            break;
        }
        // The first samples are searched together with some after them.
        before = before.saturating_sub(V::LANES);
        let (x, y) = (zero.first_of(&x[before..]), zero.first_of(&y[before..]));
        frictions = frictions.max(share(sizes, x, y));
    }
    for lane in 0..V::LANES {
        friction = friction.max(frictions.lane(lane));
    }
    friction
}

/// The share of the friction demand by which a gap must exceed it to be searched.
pub(crate) const OVER: f64 = 2.0e-4;

/// The friction demand up to a sample, crests between samples included. Where the largest |X| of a gap over its least
/// Y exceeds the largest demand so far, `within` tells the demand within the gap, backwards as [at the
/// samples](at_samples).
#[inline(always)]
pub(crate) fn crests<V: Vector>(
    motions: &MotionPair<V::Element>,
    size: V::Element,
    sample: usize,
    friction: V::Element,
    zero: V,
    mut within: impl FnMut(usize, V::Element) -> V::Element,
) -> V::Element {
    let over = V::Element::of(1.0 + OVER);
    let (h, v) = (motions.across, motions.up);
    let (magnitude, least_y) = (h.field(MAGNITUDE), v.field(LEAST));
    let (magnitude_so_far, least_so_far) = (h.field(MAGNITUDE_SO_FAR), v.field(LEAST_SO_FAR));
    let last_v = v.length - 1;
    let sizes = zero.like(size.to_f64());
    let mut friction = friction;
    let mut before = in_vectors::<V>(sample, last_v);
    for gap in (before..sample).rev() {
        if size * magnitude[gap] > over * friction * least_y[v.gap(gap)] {
            friction = within(gap, friction);
        }
    }
    while before > 0 {
        if over * friction * least_so_far[before] >= size * magnitude_so_far[before - 1] {
            break;
        }
        // The first gaps are searched together with some after them.
        let first = before.saturating_sub(V::LANES);
        let limits = zero.like((over * friction).to_f64());
        let bounds = sizes * zero.first_of(&magnitude[first..]);
        let beyond = V::bits(bounds.gt(limits * zero.first_of(&least_y[first..])));
        for lane in (0..before - first).rev().filter(|lane| beyond >> lane & 1 == 1) {
            // The gaps after it may have raised the limit.
            let gap = first + lane;
            if size * magnitude[gap] > over * friction * least_y[gap] {
                friction = within(gap, friction);
            }
        }
        before = first;
    }
    friction
}

/// The friction demand so far and within a gap, of which a cell takes the steps from the shared motions at its start.
/// They are not cut at the kinks of the Bouc-Wen law, across which z and u' are smooth enough for a gap.
#[inline(never)]
pub(crate) fn within_gap<R: Real>(
    motions: &MotionPair<R>,
    set: &CellEquations<R>,
    gap: usize,
    friction: R,
) -> R {
    let CellEquations { variant, model, cell, .. } = *set;
    let (zero, half, one) = (R::of(0.0), R::of(0.5), R::of(1.0));
    let (none, corner) = (zero.mask(0), &model.left);
    let mut state = State::zeroed();
    state.extremes.friction = friction;
    motions.move_to(cell.drive.scale, gap, &mut state);
    let (mut y, mut extremes) = (state.motion, state.extremes);
    let mut forcing = Forcing::new(zero);
    forcing.begin(0, set, gap as u32 * cell.steps.substeps, false);
    for _ in 0..cell.steps.substeps {
        let grounds = [zero, half, one].map(|at| forcing.ground(variant, cell, at));
        let k1 = rates(set, corner, none, &y, grounds[0]);
        let stepped = rk4(set, corner, none, &y, &k1, forcing.step, [grounds[1], grounds[2]]);
        let base = support(set, &stepped.y, grounds[2]);
        let end = Contact { shear: base.f_h, normal: base.f_v };
        extremes.update_contact(!none, k1.contact(), stepped.mid, end);
        y = stepped.y;
        forcing.done = forcing.done + one;
    }
    extremes.friction
}

#[inline(always)]
pub(crate) fn share<N: Number>(size: N, x: N, y: N) -> N {
    let zero = y.like(0.0);
    N::select(y.gt(zero), size * (x.abs() / y), zero)
}
