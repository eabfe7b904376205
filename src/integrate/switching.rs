//! One step with its switches inside it: uplift, impact, overturning. Twin of
//! `shaders/switching.wgsl`.
//!
//! A step is taken whole; where a guard changed sign on the way, the first switch is bracketed,
//! the step is redone up to it, the phase is switched there, and the rest of the step follows
//! from there. Nothing is moved to the step's end.

use super::locate::{Crossing, Located, crosses, locate_angle, locate_kink, locate_uplift};
use super::rk4::{Span, hermite, trial};
use super::state::{
    EVENT_LIMIT, FINISHED, RUNNING, State, check_range, observe_contact, observe_motion, overturn,
};
use crate::model::Setting;
use crate::model::block::{Corner, FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use crate::model::dynamics::{Motion, Rates, rates, uplift_moment};
use crate::model::excitation::{ground_at, step_length};
use crate::model::impact::{change_corner, come_to_rest};
use crate::model::real::Real;

/// No switch.
pub const NOTHING: u32 = 0;
/// The block lifts about the left corner.
pub const UPLIFT_LEFT: u32 = 1;
/// The block lifts about the right corner.
pub const UPLIFT_RIGHT: u32 = 2;
/// The block lands on the other corner.
pub const IMPACT: u32 = 3;
/// The block passes the overturning angle.
pub const OVERTURN: u32 = 4;
/// The Bouc-Wen law has a kink: du or z changes sign. The phase stays; the step is cut there, for
/// a step across it is of second order only.
pub const KINK: u32 = 5;

/// Switches that one step may hold. A block that chatters to rest makes about
/// [`FLIGHTS_A_STEP`](crate::sweep::cells::FLIGHTS_A_STEP) impacts in its last one.
pub const EVENT_BOUND: u32 = 128;

/// The most times itself that z of (11) may settle by in a span: RK4 is stable to 2.79.
pub const YIELD_LIMIT: f64 = 2.0;

/// What an observer of a cell's switches is told.
pub trait Log<R> {
    /// A switch of `kind` has just happened in `state.step`, `fraction` into the step;
    /// `state.motion` is the motion after it.
    fn switched(&mut self, kind: u32, fraction: R, state: &State<R>);
}

/// No one looks.
impl<R> Log<R> for () {
    #[inline(always)]
    fn switched(&mut self, _: u32, _: R, _: &State<R>) {}
}

/// The uplift that the contact forces call for now, if any.
#[inline(always)]
fn uplift_now<R: Real>(set: &Setting<R>, k: &Rates<R>) -> u32 {
    let left = uplift_moment(set, &set.model.left, k.shear, k.normal);
    let right = uplift_moment(set, &set.model.right, k.shear, k.normal);
    if left > R::of(0.0) && left >= right {
        return UPLIFT_LEFT;
    }
    if right > R::of(0.0) {
        return UPLIFT_RIGHT;
    }
    NOTHING
}

/// How many times itself z of (11) can settle by in a whole step.
#[inline(always)]
fn settling<R: Real>(set: &Setting<R>, y: &Motion<R>, step: u32) -> R {
    let n = R::of(f64::from(set.variant.bouc_wen_n));
    n * y.du.abs() * set.cell.inverse_yield * step_length(set.cell, step)
}

/// A fraction of the span at which an uplift moment is positive, from its values at the start,
/// halfway and at the end; negative if there is none.
#[inline(always)]
fn moment_rises<R: Real>(start: R, mid: R, end: R) -> R {
    if end > R::of(0.0) {
        return R::of(1.0);
    }
    // The slope of the parabola through the three falls from `rise` to `fall`.
    let rise = R::of(4.0) * mid - R::of(3.0) * start - end;
    let fall = R::of(3.0) * end - R::of(4.0) * mid + start;
    if rise > R::of(0.0) && fall < R::of(0.0) {
        let at = rise / (rise - fall);
        if start + R::of(0.5) * rise * at > R::of(0.0) {
            return at;
        }
    }
    R::of(-1.0)
}

/// The first uplift of a span in full contact.
#[inline(always)]
fn find_uplift<R: Real>(
    set: &Setting<R>,
    k1: &Rates<R>,
    shear_mid: R,
    normal_mid: R,
    k_end: &Rates<R>,
) -> Crossing<R> {
    let (left, right) = (&set.model.left, &set.model.right);
    let left0 = uplift_moment(set, left, k1.shear, k1.normal);
    let left1 = uplift_moment(set, left, k_end.shear, k_end.normal);
    let right0 = uplift_moment(set, right, k1.shear, k1.normal);
    let right1 = uplift_moment(set, right, k_end.shear, k_end.normal);
    let at_left = moment_rises(left0, uplift_moment(set, left, shear_mid, normal_mid), left1);
    let at_right = moment_rises(right0, uplift_moment(set, right, shear_mid, normal_mid), right1);
    let zero = R::of(0.0);
    let mut right_first = at_right < at_left;
    if at_right > zero && at_right >= at_left && left1 > zero && right1 > zero {
        // Both hold at the end: the one whose chord rises through zero first.
        right_first = right0 / (right0 - right1) < left0 / (left0 - left1);
    }
    if at_left > zero && !(at_right > zero && right_first) {
        return Crossing { kind: UPLIFT_LEFT, upper: at_left };
    }
    if at_right > zero {
        return Crossing { kind: UPLIFT_RIGHT, upper: at_right };
    }
    Crossing { kind: NOTHING, upper: zero }
}

/// The first impact or overturning of a span of length `h` seconds while rocking.
#[inline(always)]
fn find_crossing<R: Real>(corner: &Corner<R>, y: &Motion<R>, end: &Motion<R>, h: R) -> Crossing<R> {
    let (zero, one) = (R::of(0.0), R::of(1.0));
    let phi0 = corner.side * y.phi;
    let phi1 = corner.side * end.phi;
    if phi1 < zero {
        return Crossing { kind: IMPACT, upper: one };
    }
    if phi1 >= corner.overturn {
        return Crossing { kind: OVERTURN, upper: one };
    }
    // Two crossings in one span: the angle's extremum inside it.
    let dphi0 = corner.side * y.dphi;
    let dphi1 = corner.side * end.dphi;
    if (dphi0 < zero && dphi1 > zero) || (dphi0 > zero && dphi1 < zero) {
        let at = dphi0 / (dphi0 - dphi1);
        let extremum = hermite(phi0, h * dphi0, phi1, h * dphi1, at);
        if extremum < zero {
            return Crossing { kind: IMPACT, upper: at };
        }
        if extremum >= corner.overturn {
            return Crossing { kind: OVERTURN, upper: at };
        }
    }
    Crossing { kind: NOTHING, upper: zero }
}

/// The block lands: it goes on about the other corner, or comes to rest where it is too slow to
/// lift again, or where the law of impact leaves it no rebound (eta_phi <= 0).
pub fn land<R: Real>(set: &Setting<R>, state: &mut State<R>, leaving: &Corner<R>, fraction: R) {
    let mut landing = set.model.right;
    let mut mode = ROCKING_RIGHT;
    if state.mode == ROCKING_RIGHT {
        landing = set.model.left;
        mode = ROCKING_LEFT;
    }
    let y = state.motion;
    state.impacts += 1;
    let rebound = landing.eta_phi * y.dphi;
    let resting = come_to_rest(set, leaving, &y);
    let k = rates(set, leaving, false, &resting, ground_at(set, state.step, fraction));
    let slow = rebound.abs() < set.cell.rest_speed && uplift_now(set, &k) == NOTHING;
    if slow || landing.eta_phi <= R::of(0.0) {
        state.motion = resting;
        state.mode = FULL_CONTACT;
        return;
    }
    state.motion = change_corner(&landing, &y);
    state.mode = mode;
}

/// The block lifts about a corner; an uplift is numbered as the mode that it leads to.
#[inline(always)]
pub fn lift<R: Real>(state: &mut State<R>, kind: u32, fraction: R) {
    if state.uplifts == 0 {
        state.uplift_step = state.step;
        state.uplift_fraction = fraction;
    }
    state.uplifts += 1;
    state.mode = kind;
}

/// Takes a cell over one step; the number of switches in it.
pub fn advance<R: Real>(set: &Setting<R>, state: &mut State<R>, log: &mut impl Log<R>) -> u32 {
    let one = R::of(1.0);
    let mut start = R::of(0.0);
    let mut events = 0;
    while events < EVENT_BOUND {
        let corner = pivot(set.model, state.mode);
        let rocking = state.mode != FULL_CONTACT;
        let mut span = Span { corner, rocking, step: state.step, start, length: one - start };
        let y = state.motion;
        let k1 = rates(set, &corner, rocking, &y, ground_at(set, state.step, start));
        observe_contact(state, &k1);
        if !rocking {
            let kind = uplift_now(set, &k1);
            if kind != NOTHING {
                lift(state, kind, start);
                log.switched(kind, start, state);
                events += 1;
                continue;
            }
        }
        let mut cut = false;
        if set.variant.kinks {
            let limit = R::of(YIELD_LIMIT);
            let settling = settling(set, &y, state.step);
            if settling * span.length > limit {
                span.length = limit / settling;
                cut = true;
            }
        }
        let mut stepped = trial(set, &span, &y, &k1, span.length);
        if set.variant.kinks && (crosses(y.du, stepped.y.du) || crosses(y.z, stepped.y.z)) {
            // Up to the kink the law is smooth; the rest of the step follows from there.
            span.length = locate_kink(set, &span, &y, &k1, &stepped.y) * span.length;
            stepped = trial(set, &span, &y, &k1, span.length);
            cut = true;
        }
        let h = span.length * step_length(set.cell, state.step);
        let mut located = Located { found: false, at: one, y: stepped.y };
        let kind;
        if rocking {
            let crossing = find_crossing(&corner, &y, &stepped.y, h);
            kind = crossing.kind;
            if kind != NOTHING && !set.variant.in_step {
                located.found = crossing.upper >= one;
            } else if kind != NOTHING {
                located = locate_angle(set, &span, &y, &k1, &stepped.y, &crossing);
            }
        } else {
            let ground = ground_at(set, state.step, start + span.length);
            let k_end = rates(set, &corner, false, &stepped.y, ground);
            let crossing = find_uplift(set, &k1, stepped.shear_mid, stepped.normal_mid, &k_end);
            kind = crossing.kind;
            if kind != NOTHING && !set.variant.in_step {
                located.found = crossing.upper >= one;
            } else if kind != NOTHING {
                located = locate_uplift(set, &span, &y, &k1, &crossing);
            }
        }
        if !located.found {
            observe_motion(state, &y, &stepped.y, h);
            state.motion = stepped.y;
            if !cut {
                break;
            }
            start = start + span.length;
            log.switched(KINK, start, state);
            events += 1;
            if start >= one {
                break;
            }
            continue;
        }
        observe_motion(state, &y, &located.y, located.at * h);
        state.motion = located.y;
        start = start + located.at * span.length;
        let k = rates(set, &corner, rocking, &located.y, ground_at(set, state.step, start));
        observe_contact(state, &k);
        if kind == OVERTURN {
            overturn(state, &corner, start);
            log.switched(kind, start, state);
            return events;
        }
        if kind == IMPACT {
            land(set, state, &corner, start);
        } else {
            lift(state, kind, start);
        }
        log.switched(kind, start, state);
        events += 1;
        if start >= one {
            break;
        }
    }
    if events >= EVENT_BOUND {
        state.status = EVENT_LIMIT;
        return events;
    }
    check_range(state);
    state.step += 1;
    if state.step >= set.cell.steps && state.status == RUNNING {
        state.status = FINISHED;
    }
    events
}
