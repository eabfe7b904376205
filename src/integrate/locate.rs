//! Where in a step a switch or a kink is. Twin of `shaders/locate.wgsl`.

use super::rk4::{Span, hermite, trial};
use super::switching::{OVERTURN, UPLIFT_RIGHT};
use crate::model::Setting;
use crate::model::dynamics::{Motion, Rates, rates, uplift_moment};
use crate::model::excitation::{ground_at, step_length};
use crate::model::number::Number;
use crate::model::real::Real;

/// Trials to locate a switch: enough for bisection down to the tolerance, should all else fail.
pub const LOCATE_BOUND: u32 = 60;
/// Newton's steps on the cubic that gives the first guess.
pub const GUESS_BOUND: u32 = 12;

/// A switch somewhere in a span.
#[derive(Debug, Clone, Copy)]
pub struct Crossing<R> {
    /// What kind of switch.
    pub kind: u32,
    /// A fraction of the span at which it has happened.
    pub upper: R,
}

/// Where in the span a switch is.
#[derive(Debug, Clone, Copy)]
pub struct Located<R> {
    /// False where it turned out not to happen.
    pub found: bool,
    /// Fraction of the span.
    pub at: R,
    /// The motion there, before the switch.
    pub y: Motion<R>,
}

/// True where a number goes from one side of zero to the other; zero itself is on neither.
#[inline(always)]
pub fn crosses<N: Number>(from: N, to: N) -> N::Mask {
    let zero = from.like(0.0);
    (from.exceeds(zero) & zero.exceeds(to)) | (zero.exceeds(from) & to.exceeds(zero))
}

/// What changes sign at a kink, positive before it: z or du.
#[inline(always)]
fn before_kink<R: Real>(start: &Motion<R>, of_z: bool, y: &Motion<R>) -> R {
    let mut from = start.du;
    let mut value = y.du;
    if of_z {
        from = start.z;
        value = y.z;
    }
    if from > R::of(0.0) {
        return value;
    }
    -value
}

/// A bracket around a root, narrowed by the Illinois method: false position, with the value at an
/// end that stays twice halved.
struct Bracket<R> {
    /// Not beyond the root.
    low: R,
    value_low: R,
    /// Beyond it.
    high: R,
    value_high: R,
    /// The end that moved last: 1 the high one, 2 the low one.
    last: u32,
}

/// Where to look next.
#[inline(always)]
fn next_trial<R: Real>(bracket: &Bracket<R>) -> R {
    let (low, high) = (bracket.low, bracket.high);
    let at = high - bracket.value_high * (high - low) / (bracket.value_high - bracket.value_low);
    if at > low && at < high {
        return at;
    }
    R::of(0.5) * (low + high)
}

/// Takes in what was found there.
#[inline(always)]
fn narrow<R: Real>(bracket: &mut Bracket<R>, at: R, value: R, beyond: bool) {
    let half = R::of(0.5);
    if beyond {
        bracket.high = at;
        bracket.value_high = value;
        if bracket.last == 1 {
            bracket.value_low = half * bracket.value_low;
        }
        bracket.last = 1;
    } else {
        bracket.low = at;
        bracket.value_low = value;
        if bracket.last == 2 {
            bracket.value_high = half * bracket.value_high;
        }
        bracket.last = 2;
    }
}

/// The fraction of a span at which its first kink is, just on its far side, on the redone step.
pub fn locate_kink<R: Real>(
    set: &Setting<R>,
    span: &Span<R>,
    y: &Motion<R>,
    k1: &Rates<R>,
    end: &Motion<R>,
) -> R {
    // Where both cross, the one whose chord does so first.
    let mut of_z = crosses(y.z, end.z);
    if of_z && crosses(y.du, end.du) {
        of_z = y.z / (y.z - end.z) < y.du / (y.du - end.du);
    }
    let mut bracket = Bracket {
        low: R::of(0.0),
        value_low: before_kink(y, of_z, y),
        high: R::of(1.0),
        value_high: before_kink(y, of_z, end),
        last: 0,
    };
    let mut tries = 0;
    while tries < LOCATE_BOUND && bracket.high - bracket.low > R::KINK_TOLERANCE {
        let at = next_trial(&bracket);
        let y_at = trial(set, span, y, k1, at * span.length).y;
        let value = before_kink(y, of_z, &y_at);
        narrow(&mut bracket, at, value, value < R::of(0.0));
        tries += 1;
    }
    bracket.high
}

/// Locates an impact or an overturning: Newton on the cubic through the span's ends, then on the
/// redone step, inside a bracket.
pub fn locate_angle<R: Real>(
    set: &Setting<R>,
    span: &Span<R>,
    y: &Motion<R>,
    k1: &Rates<R>,
    end: &Motion<R>,
    crossing: &Crossing<R>,
) -> Located<R> {
    let (zero, one, half) = (R::of(0.0), R::of(1.0), R::of(0.5));
    let h = span.length * step_length(set.cell, span.step);
    // `beyond` is positive on the far side of the switch.
    let mut sense = -span.corner.side;
    let mut target = zero;
    if crossing.kind == OVERTURN {
        sense = span.corner.side;
        target = span.corner.overturn;
    }
    let x0 = sense * y.phi - target;
    let x1 = sense * end.phi - target;
    let slope0 = h * sense * y.dphi;
    let slope1 = h * sense * end.dphi;
    let mut low = zero;
    let mut high = crossing.upper;
    let mut at = crossing.upper;
    let mut tries = 0;
    while tries < GUESS_BOUND {
        let beyond = hermite(x0, slope0, x1, slope1, at);
        let rise = x1 - x0;
        let c2 = R::of(3.0) * rise - R::of(2.0) * slope0 - slope1;
        let c3 = slope0 + slope1 - R::of(2.0) * rise;
        let slope = slope0 + at * (R::of(2.0) * c2 + at * R::of(3.0) * c3);
        if beyond >= zero {
            high = at;
        } else {
            low = at;
        }
        let change = beyond / slope;
        at = at - change;
        if !(at > low && at < high) {
            at = half * (low + high);
        }
        if change.abs() < R::of(1.0e-3) {
            break;
        }
        tries += 1;
    }
    low = zero;
    high = crossing.upper;
    let mut y_high = *end;
    let mut verified = crossing.upper >= one;
    tries = 0;
    while tries < LOCATE_BOUND {
        let y_at = trial(set, span, y, k1, at * span.length).y;
        let beyond = sense * y_at.phi - target;
        let change = beyond / (h * sense * y_at.dphi);
        if change.abs() <= R::EVENT_TOLERANCE {
            return Located { found: true, at, y: y_at };
        }
        if beyond >= zero {
            high = at;
            y_high = y_at;
            verified = true;
        } else {
            low = at;
        }
        if high - low <= R::EVENT_TOLERANCE {
            break;
        }
        at = at - change;
        if !(at > low && at < high) {
            at = half * (low + high);
        }
        tries += 1;
    }
    Located { found: verified, at: high, y: y_high }
}

/// Locates an uplift on the redone step, and lands on its far side.
pub fn locate_uplift<R: Real>(
    set: &Setting<R>,
    span: &Span<R>,
    y: &Motion<R>,
    k1: &Rates<R>,
    crossing: &Crossing<R>,
) -> Located<R> {
    let zero = R::of(0.0);
    let mut corner = set.model.left;
    if crossing.kind == UPLIFT_RIGHT {
        corner = set.model.right;
    }
    let mut bracket = Bracket {
        low: zero,
        value_low: uplift_moment(set, &corner, k1.shear, k1.normal),
        high: crossing.upper,
        value_high: zero,
        last: 0,
    };
    let mut y_high = *y;
    let mut at = crossing.upper;
    let mut tries = 0;
    while tries < LOCATE_BOUND {
        let y_at = trial(set, span, y, k1, at * span.length).y;
        let ground = ground_at(set, span.step, span.start + at * span.length);
        let k = rates(set, &corner, false, &y_at, ground);
        let moment = uplift_moment(set, &corner, k.shear, k.normal);
        if moment > zero {
            y_high = y_at;
        } else if tries == 0 {
            return Located { found: false, at: zero, y: *y };
        }
        narrow(&mut bracket, at, moment, moment > zero);
        if bracket.high - bracket.low <= R::EVENT_TOLERANCE {
            break;
        }
        at = next_trial(&bracket);
        tries += 1;
    }
    Located { found: true, at: bracket.high, y: y_high }
}
