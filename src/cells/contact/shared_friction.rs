//! The friction demand of full contact, from the motions that cells share. Twin of `shaders/shared_friction.wgsl`.

use super::motions::{
    ACCELERATION, EIGHTHS_V, LEAST, LEAST_SO_FAR, MAGNITUDE, MAGNITUDE_SO_FAR, MotionPair,
    QUARTERS_H,
};
use crate::model::number::Number;
use crate::model::real::{Real, Vector};
use crate::stepping::extremes::{self, end_slopes, parabola};

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

/// The least of the parabola through three values evenly apart, and at what fraction of the way.
#[inline(always)]
fn dip<N: Number>([start, mid, end]: [N; 3]) -> (N, N) {
    let (zero, one) = (start.like(0.0), start.like(1.0));
    let (rise, fall) = end_slopes(start, mid, end);
    let outside = N::select(start.gt(end), one, zero);
    let inside = zero.gt(rise) & fall.gt(zero);
    let at = N::select(inside, rise / (rise - fall), outside);
    (parabola(start, mid, end, at), at)
}

/// The friction demand up to a sample, crests between samples included. Where the largest |X| of a gap over its least
/// Y exceeds the largest demand so far, the demand is searched for [within the gap](within_gaps), backwards as [at
/// the samples](at_samples).
#[inline(always)]
pub(crate) fn crests<V: Vector>(
    motions: &MotionPair<V::Element>,
    size: V::Element,
    sample: usize,
    friction: V::Element,
    zero: V,
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
        let gap_v = v.gap(gap);
        if size * magnitude[gap] > over * friction * least_y[gap_v] {
            friction = friction.max(within_gaps(motions, size, (gap, gap_v)));
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
        if beyond != 0 {
            let within = within_gaps(motions, sizes, (first, first));
            for lane in (0..before - first).rev().filter(|lane| beyond >> lane & 1 == 1) {
                // The gaps after it may have raised the limit.
                let gap = first + lane;
                if size * magnitude[gap] > over * friction * least_y[gap] {
                    friction = friction.max(within.lane(lane));
                }
            }
        }
        before = first;
    }
    friction
}

/// The friction demand within gaps, from these gaps of u and of v on, one in each lane: on parabolas through their
/// eighths, and at the least Y. The least Y is known; the parabolas tell its time.
#[inline(always)]
pub(crate) fn within_gaps<V: Vector>(
    motions: &MotionPair<V::Element>,
    size: V,
    (gap, gap_v): (usize, usize),
) -> V {
    let zero = size.like(0.0);
    let (h, v) = (motions.across, motions.up);
    let magnitude = zero.first_of(&h.field(MAGNITUDE)[gap..]);
    let least_y = zero.first_of(&v.field(LEAST)[gap_v..]);
    let (xs, ys) = (&h.field(ACCELERATION)[gap..], &v.field(ACCELERATION)[gap_v..]);
    let mut quarters = [zero.first_of(xs); 5];
    for (number, quarter) in quarters[1..4].iter_mut().enumerate() {
        *quarter = zero.first_of(&h.field(QUARTERS_H + number)[gap..]);
    }
    quarters[4] = zero.first_of(&xs[1..]);
    let mut eighths = [zero.first_of(ys); 9];
    for (number, eighth) in eighths[1..8].iter_mut().enumerate() {
        *eighth = zero.first_of(&v.field(EIGHTHS_V + number)[gap_v..]);
    }
    eighths[8] = zero.first_of(&ys[1..]);
    // Of spans of two eighths each: the largest share, and |X| at the least Y.
    let mut ends = zero;
    let mut top = zero;
    let (mut least, mut x_there) = (eighths[0], quarters[0]);
    for span in 0..4 {
        let half = span / 2 * 2;
        let early = zero.like(if span % 2 == 0 { 0.25 } else { 0.75 });
        let between = parabola(quarters[half], quarters[half + 1], quarters[half + 2], early);
        let x = [quarters[span], between, quarters[span + 1]];
        let y = [eighths[2 * span], eighths[2 * span + 1], eighths[2 * span + 2]];
        let start = share(size, x[0], y[0]);
        let mid = share(size, x[1], y[1]);
        let end = share(size, x[2], y[2]);
        ends = ends.max(start).max(mid).max(end);
        top = top.max(extremes::crest(start, mid, end));
        let (lower, at) = dip(y);
        let deeper = least.gt(lower);
        x_there = V::select(deeper, parabola(x[0], x[1], x[2], at), x_there);
        least = V::select(deeper, lower, least);
    }
    // The result is not above the bound because of which the gap was searched.
    let bound = share(size, magnitude, least_y).max(ends);
    let most = top.max(share(size, x_there, least_y)).max(ends).min(bound);
    V::select(least_y.gt(zero), most, ends)
}

#[inline(always)]
pub(crate) fn share<N: Number>(size: N, x: N, y: N) -> N {
    let zero = y.like(0.0);
    N::select(y.gt(zero), size * (x.abs() / y), zero)
}
