// One step with its switches inside it: uplift, impact, overturning.
// Twin: src/integrate/switching.rs.

const NOTHING = 0u;
const UPLIFT_LEFT = 1u;
const UPLIFT_RIGHT = 2u;
const IMPACT = 3u;
const OVERTURN = 4u;
const KINK = 5u;

const EVENT_BOUND = 128u;

// The most that settling may be in a span: RK4 is stable to 2.79.
const YIELD_LIMIT = 2.0;

// The uplift that the contact forces call for now, if any.
fn uplift_now(k: Rates) -> u32 {
    let left = uplift_moment(model.left, k.shear, k.normal);
    let right = uplift_moment(model.right, k.shear, k.normal);
    if left > 0.0 && left >= right {
        return UPLIFT_LEFT;
    }
    if right > 0.0 {
        return UPLIFT_RIGHT;
    }
    return NOTHING;
}

// How many times itself z of (11) can settle by in a whole step.
fn settling(cell: Cell, y: Motion, step: u32) -> real {
    return real(bouc_wen_n) * abs(y.du) * cell.inverse_yield * step_length(cell, step);
}

// A fraction of the span at which an uplift moment is positive; negative if there is none.
fn moment_rises(start: real, mid: real, end: real) -> real {
    if end > 0.0 {
        return real(1.0);
    }
    // The slope of the parabola through the three falls from `rise` to `fall`.
    let rise = 4.0 * mid - 3.0 * start - end;
    let fall = 3.0 * end - 4.0 * mid + start;
    if rise > 0.0 && fall < 0.0 {
        let at = rise / (rise - fall);
        if start + 0.5 * rise * at > 0.0 {
            return at;
        }
    }
    return real(-1.0);
}

// The first uplift of a span in full contact.
fn find_uplift(k1: Rates, shear_mid: real, normal_mid: real, k_end: Rates) -> Crossing {
    let left = model.left;
    let right = model.right;
    let left0 = uplift_moment(left, k1.shear, k1.normal);
    let left1 = uplift_moment(left, k_end.shear, k_end.normal);
    let right0 = uplift_moment(right, k1.shear, k1.normal);
    let right1 = uplift_moment(right, k_end.shear, k_end.normal);
    let at_left = moment_rises(left0, uplift_moment(left, shear_mid, normal_mid), left1);
    let at_right = moment_rises(right0, uplift_moment(right, shear_mid, normal_mid), right1);
    var right_first = at_right < at_left;
    if at_right > 0.0 && at_right >= at_left && left1 > 0.0 && right1 > 0.0 {
        // Both hold at the end: the one whose chord rises through zero first.
        right_first = right0 / (right0 - right1) < left0 / (left0 - left1);
    }
    if at_left > 0.0 && !(at_right > 0.0 && right_first) {
        return Crossing(UPLIFT_LEFT, at_left);
    }
    if at_right > 0.0 {
        return Crossing(UPLIFT_RIGHT, at_right);
    }
    return Crossing(NOTHING, real(0.0));
}

// The first impact or overturning of a span of length `h` seconds while rocking.
fn find_crossing(corner: Corner, y: Motion, end: Motion, h: real) -> Crossing {
    let phi0 = corner.side * y.phi;
    let phi1 = corner.side * end.phi;
    if phi1 < 0.0 {
        return Crossing(IMPACT, real(1.0));
    }
    if phi1 >= corner.overturn {
        return Crossing(OVERTURN, real(1.0));
    }
    // Two crossings in one span: the angle's extremum inside it.
    let dphi0 = corner.side * y.dphi;
    let dphi1 = corner.side * end.dphi;
    if (dphi0 < 0.0 && dphi1 > 0.0) || (dphi0 > 0.0 && dphi1 < 0.0) {
        let at = dphi0 / (dphi0 - dphi1);
        let extremum = hermite(phi0, h * dphi0, phi1, h * dphi1, at);
        if extremum < 0.0 {
            return Crossing(IMPACT, at);
        }
        if extremum >= corner.overturn {
            return Crossing(OVERTURN, at);
        }
    }
    return Crossing(NOTHING, real(0.0));
}

// The block lands: it goes on about the other corner, or comes to rest where it is too slow to
// lift again, or where the law of impact leaves it no rebound (eta_phi <= 0).
fn land(cell: Cell, state: ptr<function, State>, leaving: Corner, fraction: real) {
    var landing = model.right;
    var mode = ROCKING_RIGHT;
    if (*state).mode == ROCKING_RIGHT {
        landing = model.left;
        mode = ROCKING_LEFT;
    }
    let y = (*state).motion;
    (*state).impacts += 1u;
    let rebound = landing.eta_phi * y.dphi;
    let resting = come_to_rest(leaving, y);
    let k = rates(cell, leaving, false, resting, ground_at(cell, (*state).step, fraction));
    let slow = abs(rebound) < cell.rest_speed && uplift_now(k) == NOTHING;
    if slow || landing.eta_phi <= 0.0 {
        (*state).motion = resting;
        (*state).mode = FULL_CONTACT;
        return;
    }
    (*state).motion = change_corner(landing, y);
    (*state).mode = mode;
}

// The block lifts about a corner; an uplift is numbered as the mode that it leads to.
fn lift(state: ptr<function, State>, kind: u32, fraction: real) {
    if (*state).uplifts == 0u {
        (*state).uplift_step = (*state).step;
        (*state).uplift_fraction = fraction;
    }
    (*state).uplifts += 1u;
    (*state).mode = kind;
}

// Takes a cell over one step; the number of switches in it.
fn advance(cell: Cell, state: ptr<function, State>) -> u32 {
    var start: real = 0.0;
    var events = 0u;
    while events < EVENT_BOUND {
        let corner = pivot((*state).mode);
        let rocking = (*state).mode != FULL_CONTACT;
        var span = Span(corner, rocking, (*state).step, start, 1.0 - start);
        let y = (*state).motion;
        let k1 = rates(cell, corner, rocking, y, ground_at(cell, (*state).step, start));
        observe_contact(state, k1);
        if !rocking {
            let kind = uplift_now(k1);
            if kind != NOTHING {
                lift(state, kind, start);
                switched(state, kind, start);
                events += 1u;
                continue;
            }
        }
        var cut = false;
        if kinks {
            let limit: real = YIELD_LIMIT;
            let settling = settling(cell, y, (*state).step);
            if settling * span.length > limit {
                span.length = limit / settling;
                cut = true;
            }
        }
        var stepped = trial(cell, span, y, k1, span.length);
        if kinks && (crosses(y.du, stepped.y.du) || crosses(y.z, stepped.y.z)) {
            // Up to the kink the law is smooth; the rest of the step follows from there.
            span.length = locate_kink(cell, span, y, k1, stepped.y) * span.length;
            stepped = trial(cell, span, y, k1, span.length);
            cut = true;
        }
        let h = span.length * step_length(cell, (*state).step);
        var located = Located(false, real(1.0), stepped.y);
        var kind = NOTHING;
        if rocking {
            let crossing = find_crossing(corner, y, stepped.y, h);
            kind = crossing.kind;
            if kind != NOTHING && !in_step {
                located.found = crossing.upper >= 1.0;
            } else if kind != NOTHING {
                located = locate_angle(cell, span, y, k1, stepped.y, crossing);
            }
        } else {
            let ground = ground_at(cell, (*state).step, start + span.length);
            let k_end = rates(cell, corner, false, stepped.y, ground);
            let crossing = find_uplift(k1, stepped.shear_mid, stepped.normal_mid, k_end);
            kind = crossing.kind;
            if kind != NOTHING && !in_step {
                located.found = crossing.upper >= 1.0;
            } else if kind != NOTHING {
                located = locate_uplift(cell, span, y, k1, crossing);
            }
        }
        if !located.found {
            observe_motion(state, y, stepped.y, h);
            (*state).motion = stepped.y;
            if !cut {
                break;
            }
            start = start + span.length;
            switched(state, KINK, start);
            events += 1u;
            if start >= 1.0 {
                break;
            }
            continue;
        }
        observe_motion(state, y, located.y, located.at * h);
        (*state).motion = located.y;
        start = start + located.at * span.length;
        let k = rates(cell, corner, rocking, located.y, ground_at(cell, (*state).step, start));
        observe_contact(state, k);
        if kind == OVERTURN {
            overturn(state, corner, start);
            switched(state, kind, start);
            return events;
        }
        if kind == IMPACT {
            land(cell, state, corner, start);
        } else {
            lift(state, kind, start);
        }
        switched(state, kind, start);
        events += 1u;
        if start >= 1.0 {
            break;
        }
    }
    if events >= EVENT_BOUND {
        (*state).status = EVENT_LIMIT;
        return events;
    }
    check_range(state);
    (*state).step += 1u;
    if (*state).step >= cell.steps && (*state).status == RUNNING {
        (*state).status = FINISHED;
    }
    return events;
}
