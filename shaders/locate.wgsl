// Where in a step a switch or a kink is. Twin: src/integrate/locate.rs.

const LOCATE_BOUND = 60u;
const GUESS_BOUND = 12u;

struct Crossing {
    kind: u32,
    upper: real,
}

struct Located {
    found: bool,
    at: real,
    y: Motion,
}

// True where a number goes from one side of zero to the other; zero itself is on neither.
fn crosses(start: real, end: real) -> bool {
    return (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0);
}

// What changes sign at a kink, positive before it: z or du.
fn before_kink(start: Motion, of_z: bool, y: Motion) -> real {
    var before = start.du;
    var value = y.du;
    if of_z {
        before = start.z;
        value = y.z;
    }
    if before > 0.0 {
        return value;
    }
    return -value;
}

// A bracket around a root, narrowed by the Illinois method.
struct Bracket {
    low: real,
    value_low: real,
    high: real,
    value_high: real,
    // The end that moved last: 1 the high one, 2 the low one.
    last: u32,
}

// Where to look next.
fn next_trial(bracket: Bracket) -> real {
    let low = bracket.low;
    let high = bracket.high;
    let at = high - bracket.value_high * (high - low) / (bracket.value_high - bracket.value_low);
    if at > low && at < high {
        return at;
    }
    return 0.5 * (low + high);
}

// Takes in what was found there.
fn narrow(bracket: ptr<function, Bracket>, at: real, value: real, beyond: bool) {
    if beyond {
        (*bracket).high = at;
        (*bracket).value_high = value;
        if (*bracket).last == 1u {
            (*bracket).value_low = 0.5 * (*bracket).value_low;
        }
        (*bracket).last = 1u;
    } else {
        (*bracket).low = at;
        (*bracket).value_low = value;
        if (*bracket).last == 2u {
            (*bracket).value_high = 0.5 * (*bracket).value_high;
        }
        (*bracket).last = 2u;
    }
}

// The fraction of a span at which its first kink is, just on its far side, on the redone step.
fn locate_kink(cell: Cell, span: Span, y: Motion, k1: Rates, end: Motion) -> real {
    // Where both cross, the one whose chord does so first.
    var of_z = crosses(y.z, end.z);
    if of_z && crosses(y.du, end.du) {
        of_z = y.z / (y.z - end.z) < y.du / (y.du - end.du);
    }
    var bracket = Bracket(
        real(0.0),
        before_kink(y, of_z, y),
        real(1.0),
        before_kink(y, of_z, end),
        0u,
    );
    var tries = 0u;
    while tries < LOCATE_BOUND && bracket.high - bracket.low > KINK_TOLERANCE {
        let at = next_trial(bracket);
        let y_at = trial(cell, span, y, k1, at * span.length).y;
        let value = before_kink(y, of_z, y_at);
        narrow(&bracket, at, value, value < 0.0);
        tries += 1u;
    }
    return bracket.high;
}

// Locates an impact or an overturning: Newton on the cubic through the span's ends, then on the
// redone step, inside a bracket.
fn locate_angle(
    cell: Cell,
    span: Span,
    y: Motion,
    k1: Rates,
    end: Motion,
    crossing: Crossing,
) -> Located {
    let h = span.length * step_length(cell, span.step);
    // `beyond` is positive on the far side of the switch.
    var sense = -span.corner.side;
    var target_angle: real = 0.0;
    if crossing.kind == OVERTURN {
        sense = span.corner.side;
        target_angle = span.corner.overturn;
    }
    let x0 = sense * y.phi - target_angle;
    let x1 = sense * end.phi - target_angle;
    let slope0 = h * sense * y.dphi;
    let slope1 = h * sense * end.dphi;
    var low: real = 0.0;
    var high = crossing.upper;
    var at = crossing.upper;
    var tries = 0u;
    while tries < GUESS_BOUND {
        let beyond = hermite(x0, slope0, x1, slope1, at);
        let rise = x1 - x0;
        let c2 = 3.0 * rise - 2.0 * slope0 - slope1;
        let c3 = slope0 + slope1 - 2.0 * rise;
        let slope = slope0 + at * (2.0 * c2 + at * 3.0 * c3);
        if beyond >= 0.0 {
            high = at;
        } else {
            low = at;
        }
        let change = beyond / slope;
        at = at - change;
        if !(at > low && at < high) {
            at = 0.5 * (low + high);
        }
        if abs(change) < 1.0e-3 {
            break;
        }
        tries += 1u;
    }
    low = 0.0;
    high = crossing.upper;
    var y_high = end;
    var verified = crossing.upper >= 1.0;
    tries = 0u;
    while tries < LOCATE_BOUND {
        let y_at = trial(cell, span, y, k1, at * span.length).y;
        let beyond = sense * y_at.phi - target_angle;
        let change = beyond / (h * sense * y_at.dphi);
        if abs(change) <= EVENT_TOLERANCE {
            return Located(true, at, y_at);
        }
        if beyond >= 0.0 {
            high = at;
            y_high = y_at;
            verified = true;
        } else {
            low = at;
        }
        if high - low <= EVENT_TOLERANCE {
            break;
        }
        at = at - change;
        if !(at > low && at < high) {
            at = 0.5 * (low + high);
        }
        tries += 1u;
    }
    return Located(verified, high, y_high);
}

// Locates an uplift on the redone step, and lands on its far side.
fn locate_uplift(cell: Cell, span: Span, y: Motion, k1: Rates, crossing: Crossing) -> Located {
    var corner = model.left;
    if crossing.kind == UPLIFT_RIGHT {
        corner = model.right;
    }
    let moment_low = uplift_moment(corner, k1.shear, k1.normal);
    var bracket = Bracket(real(0.0), moment_low, crossing.upper, real(0.0), 0u);
    var y_high = y;
    var at = crossing.upper;
    var tries = 0u;
    while tries < LOCATE_BOUND {
        let y_at = trial(cell, span, y, k1, at * span.length).y;
        let ground = ground_at(cell, span.step, span.start + at * span.length);
        let k = rates(cell, corner, false, y_at, ground);
        let moment = uplift_moment(corner, k.shear, k.normal);
        if moment > 0.0 {
            y_high = y_at;
        } else if tries == 0u {
            return Located(false, real(0.0), y);
        }
        narrow(&bracket, at, moment, moment > 0.0);
        if bracket.high - bracket.low <= EVENT_TOLERANCE {
            break;
        }
        at = next_trial(bracket);
        tries += 1u;
    }
    return Located(true, bracket.high, y_high);
}
