// The guards: functions of the motion at whose roots a step is cut. Twin: src/stepping/guards.rs, which
// has the table.

const NOTHING = 0u;
const UPLIFT_LEFT = 1u;
const UPLIFT_RIGHT = 2u;
const IMPACT = 3u;
const OVERTURN = 4u;
const KINK = 5u;

const EVENT_BOUND = 128u;
const LOCATE_BOUND = 60u;

// The guard that is searched for, one at most: a number takes the place of the six flags of the twin, which would
// take a register each.
alias Sought = u32;

const NOTHING_SOUGHT = 0u;
// The search found no root; the next trial covers the whole span.
const SOUGHT_AGAIN = 1u;
const SOUGHT_UPLIFT = 2u;
const SOUGHT_IMPACT = 3u;
const SOUGHT_OVERTURNING = 4u;
const SOUGHT_KINK_U = 5u;
const SOUGHT_KINK_Z = 6u;
const SOUGHT_STOP = 7u;

fn is_kink(sought: Sought) -> bool {
    return sought >= SOUGHT_KINK_U;
}

fn is_angle(sought: Sought) -> bool {
    return sought == SOUGHT_IMPACT || sought == SOUGHT_OVERTURNING;
}

fn is_any(sought: Sought) -> bool {
    return sought > SOUGHT_AGAIN;
}

// The tolerance of the time of a guard, as a fraction of the step.
fn tolerance_of(sought: Sought) -> real {
    let event: real = EVENT_TOLERANCE;
    let kink: real = KINK_TOLERANCE;
    return select(event, kink, is_kink(sought) && sought != SOUGHT_STOP);
}

// A guard at the end of a trial.
struct GuardSample {
    value: real,
    slope: real,
    bend: real,
    rounding: real,
}

// True where a number changes from one side of zero to the other; zero itself is on neither side.
fn crosses(start: real, end: real) -> bool {
    return (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0);
}

// Impact or overturning: by how much the angle exceeds a target, in the direction +1 or -1.
fn angle_guard(sense: real, goal: real, y: Motion, k: Rates, h: real) -> GuardSample {
    let zero: real = 0.0;
    return GuardSample(sense * y.phi - goal, h * sense * y.dphi, h * h * sense * k.ddphi, zero);
}

// A kink: u' or z, positive after it has left the side of zero on which it was at the start.
fn kink_guard(of_z: bool, start: Motion, y: Motion, k: Rates, h: real) -> GuardSample {
    let zero: real = 0.0;
    let before = select(start.du, start.z, of_z);
    let value = select(y.du, y.z, of_z);
    let slope = h * select(k.ddu, k.dz, of_z);
    let positive = before > 0.0;
    let reached = select(value, -value, positive);
    return GuardSample(reached, select(slope, -slope, positive), zero, zero);
}

// The end stop: positive if the base is against a stop that it did not touch at the start of the span, or if it has
// left the stop that it touched. Its slope is over a span of `h` seconds.
fn end_stop_guard(cell: Cell, y: Motion, k: Rates, h: real) -> GuardSample {
    let zero: real = 0.0;
    let side = side_of(y.u);
    let pushed = cell.horizontal.stop_stiffness * (side * y.u - cell.horizontal.stop_gap);
    let force = stop_force(cell, side, y);
    let value = min(pushed, force);
    var slope = cell.horizontal.stop_stiffness * side * y.du;
    let damped = cell.horizontal.stop_damping * side * k.ddu;
    slope = select(slope, slope + damped, pushed > force);
    let off = abs(stop) <= 0.0;
    let damping = cell.horizontal.stop_damping * abs(y.du);
    let size = cell.horizontal.stop_stiffness * (abs(y.u) + cell.horizontal.stop_gap) + damping;
    return GuardSample(
        select(-value, value, off),
        h * select(-slope, slope, off),
        zero,
        ROUNDING * size,
    );
}
