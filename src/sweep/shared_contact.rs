//! The full contact that cells share: where it takes a cell before the cell lifts. Twin of
//! `shaders/shared_contact.wgsl`; the motions are made in [`full_contact`](super::full_contact).

use fearless_simd::dispatch;

use super::full_contact::FullContactMotions;
use super::motions::{
    ACCELERATION, BOTTOM, CREST, DEEPEST, DISPLACEMENT, EIGHTHS_V, HIGHEST, HYSTERETIC, LEAST,
    LOWEST, MOST, QUARTERS_H, STRONGEST, TOP, TROUGH, VELOCITY,
};
use crate::model::block::Model;
use crate::model::excitation::Cell;
use crate::model::motion::Motion;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::stepping::extremes::{self, end_slopes, parabola};
use crate::stepping::state::{FINISHED, State};

/// Gaps between samples that a cell is looked through at once.
const BLOCK: usize = 16;

/// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
/// (14) is between two bounds, and Y above one.
#[inline(always)]
fn lifts<R: Real>(arms: [R; 2], lever: R, most: R, least: R, least_y: R) -> bool {
    // A negative lever turns the bounds about.
    let (one, other) = (lever * most, lever * least);
    (one.max(other) > arms[0] * least_y) | ((-one).max(-other) > arms[1] * least_y)
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
        dispatch!(motions.level, _simd => {
            if motions.forces {
                let (sample, friction) = gap_by_gap::<R, true>(motions, arms, place, scale, lever);
                (sample, crests(motions, place, scale.abs(), sample, friction))
            } else {
                gap_by_gap::<R, false>(motions, arms, place, scale, lever)
            }
        })
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
/// looked at.
#[inline(always)]
fn gap_by_gap<R: Real, const FORCES: bool>(
    motions: &FullContactMotions<R>,
    arms: [R; 2],
    place: &Place,
    scale: R,
    lever: R,
) -> (usize, R) {
    let zero = R::of(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (most, least, x) = (h.field(MOST), h.field(LEAST), h.field(ACCELERATION));
    let (least_y, y) = (&v.field(LEAST)[..last_v], v.field(ACCELERATION));
    let size = scale.abs();
    let mut friction = zero;
    let mut sample = 0;
    // Whole blocks of gaps at once, without a branch in them.
    while sample + BLOCK <= last.min(last_v)
        && let Some(most) = most[sample..].first_chunk::<BLOCK>()
        && let Some(least) = least[sample..].first_chunk::<BLOCK>()
        && let Some(x) = x[sample..].first_chunk::<BLOCK>()
        && let Some(least_y) = least_y[sample..].first_chunk::<BLOCK>()
        && let Some(y) = y[sample..].first_chunk::<BLOCK>()
    {
        let mut any = false;
        let mut largest = friction;
        for i in 0..BLOCK {
            any |= lifts(arms, lever, most[i], least[i], least_y[i]);
            if FORCES {
                let share = size * x[i].abs() / y[i];
                largest = largest.max(if y[i] > zero { share } else { zero });
            }
        }
        if any {
            break;
        }
        friction = largest;
        sample += BLOCK;
    }
    while sample < last {
        let gap = sample.min(last_v - 1);
        if lifts(arms, lever, most[sample], least[sample], least_y[gap]) {
            break;
        }
        if FORCES && y[gap] > zero {
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
fn dip<R: Real>([start, mid, end]: [R; 3]) -> (R, R) {
    let (zero, one) = (R::of(0.0), R::of(1.0));
    let (rise, fall) = end_slopes(start, mid, end);
    let inside = rise < zero && fall > zero;
    let at = if inside {
        rise / (rise - fall)
    } else if end < start {
        one
    } else {
        zero
    };
    (parabola(start, mid, end, at), at)
}

/// The friction asked for up to a sample, crests between samples included: in gaps where the largest
/// |X| over the least Y exceeds the largest so far, it is looked for on parabolas through eighths of them,
/// and where Y is least. How small Y is there is known; the parabolas tell when.
#[inline(always)]
fn crests<R: Real>(
    motions: &FullContactMotions<R>,
    place: &Place,
    size: R,
    sample: usize,
    friction: R,
) -> R {
    let (zero, over) = (R::of(0.0), R::of(1.0 + OVER));
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (crest, trough) = (h.field(CREST), v.field(TROUGH));
    let (xs, ys) = (h.field(ACCELERATION), v.field(ACCELERATION));
    let last_v = v.length - 1;
    let share = |x: R, y: R| if y > zero { size * (x.abs() / y) } else { zero };
    let mut friction = friction;
    for gap in 0..sample {
        let gap_v = gap.min(last_v - 1);
        if !(size * crest[gap] > over * friction * trough[gap_v]) {
            continue;
        }
        let quarter = |number: usize| match number {
            0 => xs[gap],
            4 => xs[gap + 1],
            _ => h.field(QUARTERS_H + number - 1)[gap],
        };
        let eighth = |number: usize| match number {
            0 => ys[gap_v],
            8 => ys[gap_v + 1],
            _ => v.field(EIGHTHS_V + number - 1)[gap_v],
        };
        // Of spans of two eighths each: the largest share, and |X| where Y is least.
        let mut ends = zero;
        let mut top = zero;
        let (mut least, mut x_there) = (ys[gap_v], xs[gap]);
        for span in 0..4 {
            let half = span / 2 * 2;
            let xs_half = (quarter(half), quarter(half + 1), quarter(half + 2));
            let early = if span % 2 == 0 { 0.25 } else { 0.75 };
            let x = [
                quarter(span),
                parabola(xs_half.0, xs_half.1, xs_half.2, R::of(early)),
                quarter(span + 1),
            ];
            let y = [eighth(2 * span), eighth(2 * span + 1), eighth(2 * span + 2)];
            let (start, mid, end) = (share(x[0], y[0]), share(x[1], y[1]), share(x[2], y[2]));
            ends = ends.max(start).max(mid).max(end);
            top = top.max(extremes::crest(start, mid, end));
            let (lower, at) = dip(y);
            if lower < least {
                (least, x_there) = (lower, parabola(x[0], x[1], x[2], at));
            }
        }
        let mut most = ends;
        if trough[gap_v] > zero {
            // No more than the bound that the gap was looked into for.
            let bound = share(crest[gap], trough[gap_v]);
            most = top.max(share(x_there, trough[gap_v])).max(ends).min(bound.max(ends));
        }
        friction = friction.max(most);
    }
    friction
}
