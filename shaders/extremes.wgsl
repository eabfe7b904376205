// The largest and least values of a cell so far. Twin: src/stepping/extremes.rs.

struct Extremes {
    max_phi_left: real,
    max_phi_right: real,
    max_u: real,
    least_v: real,
    most_v: real,
    min_contact: real,
    friction: real,
    acc_plate: real,
    acc_block: real,
    acc_plate_total: real,
    acc_block_total: real,
    base_load: real,
    stop_force: real,
    stop_hits: real,
}

// The values that are looked for: the largest rotations, the largest |u| and |v|, the least contact force and the
// friction asked for.
override angles: bool = true;
override displacements: bool = true;
override forces: bool = true;
// The largest accelerations of plate and block, and what the base carries; the largest force on the end stop, and how often it is met.
override accelerations: bool = false;
override stop_values: bool = false;

// The most of t (1 - t)^2 in a span: what a cubic's slope at an end can add to its values.
const SLOPE_SHARE = 4.0 / 27.0;

// The largest magnitude of a coordinate: the larger of the one so far and that of a span, its interior
// extremum included.
fn peak(so_far: real, x0: real, rate0: real, x1: real, rate1: real, h: real) -> real {
    let ends = max(abs(x0), abs(x1));
    let most = max(so_far, ends);
    let bound = ends + SLOPE_SHARE * h * (abs(rate0) + abs(rate1));
    if !(crosses(rate0, rate1) && bound > most) {
        return most;
    }
    let at = rate0 / (rate0 - rate1);
    return max(most, abs(hermite(x0, h * rate0, x1, h * rate1, at)));
}

struct Range {
    least: real,
    most: real,
}

// The least and the largest value of a coordinate: those so far and those of a span, its interior
// extremum included.
fn range(so_far: Range, x0: real, rate0: real, x1: real, rate1: real, h: real) -> Range {
    let low = min(x0, x1);
    let high = max(x0, x1);
    let least = min(so_far.least, low);
    let most = max(so_far.most, high);
    let beyond = SLOPE_SHARE * h * (abs(rate0) + abs(rate1));
    let passes = high + beyond > most || least > low - beyond;
    if !(crosses(rate0, rate1) && passes) {
        return Range(least, most);
    }
    let at = rate0 / (rate0 - rate1);
    let extremum = hermite(x0, h * rate0, x1, h * rate1, at);
    return Range(min(least, extremum), max(most, extremum));
}

struct EndSlopes {
    rise: real,
    fall: real,
}

// The slopes at both ends, over the whole span, of the parabola through its start, middle and end.
fn end_slopes(start: real, mid: real, end: real) -> EndSlopes {
    return EndSlopes(4.0 * mid - 3.0 * start - end, 3.0 * end - 4.0 * mid + start);
}

// The extremum of the parabola through a span's start, middle and end, where it lies inside; else the
// start.
fn crest(start: real, mid: real, end: real) -> real {
    let slope = end_slopes(start, mid, end);
    let top = start + 0.5 * slope.rise * slope.rise / (slope.rise - slope.fall);
    return select(start, top, crosses(slope.rise, slope.fall));
}

// How far a parabola through three values can go beyond them: its extremum is at most a quarter of the
// span from the nearest.
fn bend(start: real, mid: real, end: real) -> real {
    return 0.125 * abs(start - 2.0 * mid + end);
}

// Updates those extremes that are asked for by the motion over a span of `h` seconds.
fn update_motion(state: ptr<function, State>, y0: Motion, y1: Motion, h: real) {
    if displacements {
        (*state).extremes.max_u = peak((*state).extremes.max_u, y0.u, y0.du, y1.u, y1.du, h);
        let range_v = range(Range((*state).extremes.least_v, (*state).extremes.most_v), y0.v, y0.dv, y1.v, y1.dv, h);
        (*state).extremes.least_v = range_v.least;
        (*state).extremes.most_v = range_v.most;
    }
    if !angles || (*state).mode == FULL_CONTACT {
        return;
    }
    let left = (*state).mode != ROCKING_RIGHT;
    let so_far = select((*state).extremes.max_phi_right, (*state).extremes.max_phi_left, left);
    let angle = peak(so_far, y0.phi, y0.dphi, y1.phi, y1.dphi, h);
    if left {
        (*state).extremes.max_phi_left = angle;
    } else {
        (*state).extremes.max_phi_right = angle;
    }
}

// The largest value of a quantity: the larger of the one so far and that of the parabola through its values at a span's
// start, middle and end.
fn highest(so_far: real, start: real, mid: real, end: real) -> real {
    return max(so_far, max(max(start, mid), max(end, crest(start, mid, end))));
}

// Accelerations of the upper plate and of the block's centre of mass at an instant, and what the base carries, m/s^2.
struct Accelerations {
    // Magnitude of the upper plate's horizontal acceleration.
    plate: real,
    // The same of the centre of mass.
    block: real,
    // Magnitude of the upper plate's acceleration with gravity: g at rest.
    plate_total: real,
    // The same of the centre of mass: the contact force over M.
    block_total: real,
    // Vertical force that the base carries over M: of the block and of the plates.
    load: real,
}

// Those that belong to second derivatives of u and v, to a contact force and to the ground's accelerations.
fn accelerations_of(ddu: real, ddv: real, contact: Contact, ground: Ground) -> Accelerations {
    let plate_h = ddu + ground.h;
    let below = ground.v + model.gravity;
    let plate_v = ddv + below;
    return Accelerations(
        abs(plate_h),
        abs(contact.shear),
        sqrt(plate_h * plate_h + plate_v * plate_v),
        sqrt(contact.shear * contact.shear + contact.normal * contact.normal),
        base_load(contact.normal, plate_v, below),
    );
}

// The end stop's force over M_t, and its rate; zero where the base is not against it.
struct StopEnd {
    force: real,
    rate: real,
}

fn stop_end(cell: Cell, y: Motion, k: Rates) -> StopEnd {
    let zero: real = 0.0;
    let on = abs(stop) > 0.0;
    let force = stop_force(cell, stop, y);
    let rate = stop * (cell.horizontal.stop_stiffness * y.du + cell.horizontal.stop_damping * k.ddu);
    return StopEnd(select(zero, force, on), select(zero, rate, on));
}

// Updates the largest accelerations, and what the base carries, by those at a span's start, middle and end.
fn update_accelerations(state: ptr<function, State>, start: Accelerations, mid: Accelerations, end: Accelerations) {
    let so_far = (*state).extremes;
    (*state).extremes.acc_plate = highest(so_far.acc_plate, start.plate, mid.plate, end.plate);
    (*state).extremes.acc_block = highest(so_far.acc_block, start.block, mid.block, end.block);
    (*state).extremes.acc_plate_total = highest(so_far.acc_plate_total, start.plate_total, mid.plate_total, end.plate_total);
    (*state).extremes.acc_block_total = highest(so_far.acc_block_total, start.block_total, mid.block_total, end.block_total);
    (*state).extremes.base_load = highest(so_far.base_load, start.load, mid.load, end.load);
}

// Updates the largest force on the end stop by that at the ends of a span of `h` seconds, and counts a base that has met it
// there.
fn update_stop(state: ptr<function, State>, start: StopEnd, end: StopEnd, h: real, meets: bool) {
    (*state).extremes.stop_force = peak((*state).extremes.stop_force, start.force, start.rate, end.force, end.rate, h);
    if meets {
        (*state).extremes.stop_hits += 1.0;
    }
}

fn share(shear: real, normal: real) -> real {
    let zero: real = 0.0;
    return select(zero, shear / normal, normal > 0.0);
}

// Updates the extremes by the contact forces at a span's start, middle and end, and by the crests of
// the parabolas through them: an extremum between two steps counts.
fn update_contact(state: ptr<function, State>, start: Contact, mid: Contact, end: Contact) {
    let least = min(min(start.normal, mid.normal), end.normal);
    let lowest = least - bend(start.normal, mid.normal, end.normal);
    if (*state).extremes.min_contact > lowest {
        let value = min(least, crest(start.normal, mid.normal, end.normal));
        (*state).extremes.min_contact = min((*state).extremes.min_contact, value);
    }
    let shear0 = abs(start.shear);
    let shear1 = abs(mid.shear);
    let shear2 = abs(end.shear);
    let most = max(max(shear0, shear1), shear2) + bend(shear0, shear1, shear2);
    if most > (*state).extremes.friction * lowest {
        let share0 = share(shear0, start.normal);
        let share1 = share(shear1, mid.normal);
        let share2 = share(shear2, end.normal);
        // Where the force turns tensile on the way there is no share at one of the three.
        let largest = max(max(share0, share1), share2);
        let top = max(largest, crest(share0, share1, share2));
        (*state).extremes.friction = max((*state).extremes.friction, select(largest, top, least > 0.0));
    }
}
