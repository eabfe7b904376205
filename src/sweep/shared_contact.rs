//! The full contact that cells share: where it takes a cell before the cell lifts. Twin of
//! `shaders/shared_contact.wgsl`; the motions are made in [`full_contact`](super::full_contact).

use super::full_contact::FullContactMotions;
use super::motions::{
    ACCELERATION, BOTTOM, CREST, DEEPEST, DISPLACEMENT, EIGHTHS_V, HIGHEST, HYSTERETIC, LEAST,
    LOWEST, MOST, QUARTERS_H, STRONGEST, TOP, TROUGH, VELOCITY,
};
use super::vectors::vectorized;
use crate::model::block::Model;
use crate::model::excitation::Cell;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};
use crate::scene::grid::Place;
use crate::stepping::extremes::{self, end_slopes, parabola};
use crate::stepping::state::{FINISHED, State};

/// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
/// (14) is between two bounds, and Y above one.
#[inline(always)]
fn lifts<N: Number>(arms: [N; 2], lever: N, most: N, least: N, least_y: N) -> N::Mask {
    // A negative lever turns the bounds about.
    let (one, other) = (lever * most, lever * least);
    one.max(other).gt(arms[0] * least_y) | (-one).max(-other).gt(arms[1] * least_y)
}

/// The first of some gaps whose bound, which does not fall from gap to gap, times `size` exceeds
/// `limit`.
#[inline(always)]
fn first_beyond<R: Real>(bounds: &[R], size: R, limit: R) -> usize {
    bounds.partition_point(|bound| !(size * *bound > limit))
}

/// Takes a cell from its start to the first gap in which it may lift, or to the end of the
/// excitation.
#[inline(always)]
pub(super) fn full_contact<R: Real>(
    motions: &FullContactMotions<R>,
    model: &Model<R>,
    place: &Place,
    scale: R,
    cell: &Cell<R>,
    state: &mut State<R>,
) {
    let zero = R::of(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    // u is A_h times what it is for A_h = 1.
    let lever = model.height * scale;
    let arms = [model.left.arm, model.right.arm];
    // The last sample ends no gap. A motion of v at rest is as long as it is asked for.
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (sample, friction) = if motions.still {
        // Nothing but u changes from gap to gap: the first that lifts is searched for.
        let (y, least_y) = (v.field(ACCELERATION)[0], v.field(LEAST)[0]);
        let [left, right] = arms;
        let (rising, falling) = if lever < zero { (right, left) } else { (left, right) };
        let size = lever.abs();
        let highest = first_beyond(&h.field(HIGHEST)[..last], size, rising * least_y);
        let deepest = first_beyond(&h.field(DEEPEST)[..last], size, falling * least_y);
        let sample = highest.min(deepest);
        let pressed = sample > 0 && y > zero;
        let strongest = h.field(STRONGEST)[sample.max(1) - 1];
        (sample, if pressed { scale.abs() * strongest / y } else { zero })
    } else {
        // A scan along rows of numbers, with the widest vectors that this machine has.
        let (mut found, none) = ((0, zero), zero);
        vectorized!(motions.level, none => {
            found = if motions.forces {
                let (sample, friction) = gap_by_gap::<_, true>(motions, arms, place, scale, lever, none);
                (sample, crests(motions, place, scale.abs(), sample, friction, none))
            } else {
                gap_by_gap::<_, false>(motions, arms, place, scale, lever, none)
            };
        });
        found
    };
    let at = sample.min(last_v);
    let z = h.field(HYSTERETIC)[sample];
    state.motion = Motion {
        u: scale * h.field(DISPLACEMENT)[sample],
        du: scale * h.field(VELOCITY)[sample],
        v: v.field(DISPLACEMENT)[at],
        dv: v.field(VELOCITY)[at],
        z: if scale < zero { -z } else { z },
        phi: zero,
        dphi: zero,
    };
    state.max_u = scale.abs() * h.field(TOP)[sample];
    state.least_v = v.field(BOTTOM)[at];
    state.most_v = v.field(TOP)[at];
    let lowest = v.field(LOWEST)[at];
    if lowest < state.min_contact {
        state.min_contact = lowest;
    }
    state.friction = friction;
    // A sample is a step of the cell or more, of which there are fewer than 2^32.
    state.step = (sample as u32 * cell.substeps).min(cell.steps_forced);
    if state.step >= cell.steps {
        state.status = FINISHED;
    }
}

/// The first gap in which a cell may lift, or the last sample, and the friction asked for up to it where forces are
/// looked at: vector by vector, then gap by gap.
#[inline(always)]
fn gap_by_gap<V: Vector, const FORCES: bool>(
    motions: &FullContactMotions<V::Element>,
    arms: [V::Element; 2],
    place: &Place,
    scale: V::Element,
    lever: V::Element,
    zero: V,
) -> (usize, V::Element) {
    let none = V::Element::of(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (most, least, x) = (h.field(MOST), h.field(LEAST), h.field(ACCELERATION));
    let (least_y, y) = (&v.field(LEAST)[..last_v], v.field(ACCELERATION));
    let size = scale.abs();
    let lever_of_all = zero.like(lever.to_f64());
    let size_of_all = zero.like(size.to_f64());
    let arms_of_all = [zero.like(arms[0].to_f64()), zero.like(arms[1].to_f64())];
    // The largest in each lane.
    let mut frictions = zero;
    let mut sample = 0;
    while sample + V::LANES <= last.min(last_v) {
        let (most, least) = (zero.first_of(&most[sample..]), zero.first_of(&least[sample..]));
        let least_y = zero.first_of(&least_y[sample..]);
        if V::any(lifts(arms_of_all, lever_of_all, most, least, least_y)) {
            break;
        }
        if FORCES {
            let (x, y) = (zero.first_of(&x[sample..]), zero.first_of(&y[sample..]));
            let share = V::select(y.gt(zero), size_of_all * x.abs() / y, zero);
            frictions = frictions.max(share);
        }
        sample += V::LANES;
    }
    let mut friction = none;
    for lane in 0..V::LANES {
        friction = friction.max(frictions.lane(lane));
    }
    while sample < last {
        let gap = sample.min(last_v - 1);
        if lifts(arms, lever, most[sample], least[sample], least_y[gap]) {
            break;
        }
        if FORCES && y[gap] > none {
            friction = friction.max(size * x[sample].abs() / y[gap]);
        }
        sample += 1;
    }
    (sample, friction)
}

/// Share of the friction asked for by which a gap must exceed it to be looked into.
const OVER: f64 = 2.0e-4;

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

/// The friction asked for up to a sample, crests between samples included: in gaps where the largest
/// |X| over the least Y exceeds the largest so far it is looked for [within the gap](within_gaps). A motion grows until the
/// block lifts: from the last gap backwards, few exceed the largest so far.
#[inline(always)]
fn crests<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    place: &Place,
    size: V::Element,
    sample: usize,
    friction: V::Element,
    zero: V,
) -> V::Element {
    let over = V::Element::of(1.0 + OVER);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (crest, trough) = (h.field(CREST), v.field(TROUGH));
    let last_v = v.length - 1;
    let sizes = zero.like(size.to_f64());
    let mut friction = friction;
    let both = sample.min(last_v);
    let mut before = if both < V::LANES { 0 } else { both };
    for gap in (before..sample).rev() {
        let gap_v = gap.min(last_v - 1);
        if size * crest[gap] > over * friction * trough[gap_v] {
            friction = friction.max(within_gaps(motions, place, size, (gap, gap_v)));
        }
    }
    while before > 0 {
        // The first gaps are looked at with some after them.
        let first = before.saturating_sub(V::LANES);
        let limits = zero.like((over * friction).to_f64());
        let bounds = sizes * zero.first_of(&crest[first..]);
        let beyond = V::bits(bounds.gt(limits * zero.first_of(&trough[first..])));
        if beyond != 0 {
            let within = within_gaps(motions, place, sizes, (first, first));
            for lane in (0..before - first).rev().filter(|lane| beyond >> lane & 1 == 1) {
                // Those after it may have raised the limit.
                let gap = first + lane;
                if size * crest[gap] > over * friction * trough[gap] {
                    friction = friction.max(within.lane(lane));
                }
            }
        }
        before = first;
    }
    friction
}

/// The friction asked for within gaps, from these of u and of v on, one in each lane: on parabolas through eighths of
/// them, and where Y is least. How small Y is there is known; the parabolas tell when.
#[inline(always)]
fn within_gaps<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    place: &Place,
    size: V,
    (gap, gap_v): (usize, usize),
) -> V {
    let zero = size.like(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let crest = zero.first_of(&h.field(CREST)[gap..]);
    let trough = zero.first_of(&v.field(TROUGH)[gap_v..]);
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
    // Of spans of two eighths each: the largest share, and |X| where Y is least.
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
    // No more than the bound that the gap was looked into for.
    let bound = share(size, crest, trough).max(ends);
    let most = top.max(share(size, x_there, trough)).max(ends).min(bound);
    V::select(trough.gt(zero), most, ends)
}

#[inline(always)]
fn share<N: Number>(size: N, x: N, y: N) -> N {
    let zero = y.like(0.0);
    N::select(y.gt(zero), size * (x.abs() / y), zero)
}
