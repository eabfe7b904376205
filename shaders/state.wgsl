// What a cell carries from step to step, and what it has seen. Twin: src/integrate/state.rs.

const RUNNING = 0u;
const FINISHED = 1u;
const OVERTURNED_LEFT = 2u;
const OVERTURNED_RIGHT = 3u;
const EVENT_LIMIT = 4u;
const DIVERGED = 5u;
const PROVED = 6u;

struct State {
    motion: Motion,
    max_phi_left: real,
    max_phi_right: real,
    max_u: real,
    max_v: real,
    min_contact: real,
    friction: real,
    uplift_fraction: real,
    end_fraction: real,
    mode: u32,
    step: u32,
    impacts: u32,
    uplifts: u32,
    uplift_step: u32,
    status: u32,
}

// Largest magnitude of a coordinate over a span, its interior extremum included.
fn peak(x0: real, rate0: real, x1: real, rate1: real, h: real) -> real {
    let ends = max(abs(x0), abs(x1));
    if (rate0 > 0.0) == (rate1 > 0.0) {
        return ends;
    }
    let at = rate0 / (rate0 - rate1);
    return max(ends, abs(hermite(x0, h * rate0, x1, h * rate1, at)));
}

// Takes the motion over a span of length `h` seconds into the cell's largest values.
fn observe_motion(state: ptr<function, State>, y0: Motion, y1: Motion, h: real) {
    (*state).max_u = max((*state).max_u, peak(y0.u, y0.du, y1.u, y1.du, h));
    (*state).max_v = max((*state).max_v, peak(y0.v, y0.dv, y1.v, y1.dv, h));
    let angle = peak(y0.phi, y0.dphi, y1.phi, y1.dphi, h);
    if (*state).mode == ROCKING_LEFT {
        (*state).max_phi_left = max((*state).max_phi_left, angle);
    } else {
        (*state).max_phi_right = max((*state).max_phi_right, angle);
    }
}

// Takes the contact forces of an instant into the cell's extremes.
fn observe_contact(state: ptr<function, State>, k: Rates) {
    if k.normal < (*state).min_contact {
        (*state).min_contact = k.normal;
    }
    let shear = abs(k.shear);
    if shear > (*state).friction * k.normal && k.normal > 0.0 {
        (*state).friction = shear / k.normal;
    }
}

// Ends the cell with the block overturned about `corner`.
fn overturn(state: ptr<function, State>, corner: Corner, fraction: real) {
    (*state).end_fraction = fraction;
    (*state).status = OVERTURNED_RIGHT;
    if corner.side > 0.0 {
        (*state).status = OVERTURNED_LEFT;
    }
}

// Largest |phi| that sine and cosine hold for, rad.
const PHI_RANGE = 1.65;

// Ends a cell whose motion is out of every physical range.
fn check_range(state: ptr<function, State>) {
    let y = (*state).motion;
    let size = abs(y.u) + abs(y.v) + abs(y.z) + abs(y.phi);
    if !(size < 1.0e4 && abs(y.phi) <= PHI_RANGE) {
        (*state).status = DIVERGED;
    }
}
