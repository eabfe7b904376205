// The first guard that has happened in a span just taken. Twin: src/stepping/crossing.rs.

struct Crossing {
    found: Sought,
    cubic: Cubic,
    upper: real,
}

struct Rise {
    cubic: Cubic,
    at: real,
}

// The error of a parabola at a crest, as a share of its second difference.
const CREST_ERROR = 1.0e-3;

// Bound on the rounding error of an uplift moment.
fn moment_rounding(contact: Contact) -> real {
    let arm = max(model.left.arm, model.right.arm);
    return ROUNDING * (model.height * abs(contact.shear) + arm * abs(contact.normal));
}

// An upper bound of the uplift moment in a span with these contact forces at its start, middle and end: a parabola
// exceeds three of its values by at most an eighth of their second difference.
fn highest_moment(start: Contact, mid: Contact, end: Contact) -> real {
    let arm = max(model.left.arm, model.right.arm);
    let shear = abs(start.shear - 2.0 * mid.shear + end.shear);
    let normal = abs(start.normal - 2.0 * mid.normal + end.normal);
    let ends = max(largest_uplift_moment(start), largest_uplift_moment(end));
    let values = max(ends, largest_uplift_moment(mid));
    return values + (0.125 + CREST_ERROR) * (model.height * shear + arm * normal);
}

// The parabola through the values of an uplift moment at the start, the middle and the end of a span, and the place
// in the span where the moment is, or may be, positive; the place is negative where there is none.
fn moment_rises(start: real, mid: real, end: real) -> Rise {
    let zero: real = 0.0;
    let one: real = 1.0;
    // The slope falls from `rise` to `fall`.
    let slope = end_slopes(start, mid, end);
    let rise = slope.rise;
    let fall = slope.fall;
    let top = rise / (rise - fall);
    let missed = 0.25 * CREST_ERROR * (fall - rise);
    let inside = rise > 0.0 && fall < 0.0 && start + 0.5 * rise * top > missed;
    let at = select(select(-one, top, inside), one, end > 0.0);
    return Rise(Cubic(start, rise, 0.5 * (fall - rise), zero), at);
}

// The first kink in a span of `h` seconds.
fn kinks_in(y: Motion, y1: Motion, k1: Rates, k_end: Rates, h: real) -> Crossing {
    let one: real = 1.0;
    let zero: real = 0.0;
    let of_z = crosses(y.z, y1.z);
    let of_du = crosses(y.du, y1.du);
    if !of_z && !of_du {
        return Crossing(NOTHING_SOUGHT, Cubic(-one, zero, zero, zero), one);
    }
    // Where both change sign, the one whose chord does so first.
    let z_first = abs(y.du * (y.z - y1.z)) > abs(y.z * (y.du - y1.du));
    let kink_z = of_z && (!of_du || z_first);
    let start = kink_guard(kink_z, y, y, k1, h);
    let end = kink_guard(kink_z, y, y1, k_end, h);
    let found = select(SOUGHT_KINK_U, SOUGHT_KINK_Z, kink_z);
    return Crossing(found, cubic_through(start, end), one);
}

// The place where the base meets its end stop or leaves it in a span of `h` seconds: before a kink that is found in
// the span, or without a kink.
fn stops_in(cell: Cell, kink: Crossing, y: Motion, y1: Motion, k1: Rates, k_end: Rates, h: real) -> Crossing {
    let one: real = 1.0;
    let end = end_stop_guard(cell, y1, k_end, h);
    if !(end.value > 0.0) {
        return kink;
    }
    let start = end_stop_guard(cell, y, k1, h);
    // The chords decide, as for two kinks in a span; where no other guard is found, its cubic begins at -1 and is
    // constant.
    let c = kink.cubic;
    let kink_rise = c.c1 + c.c2 + c.c3;
    let earlier = abs(start.value * kink_rise) >= abs(c.c0 * (end.value - start.value));
    if is_any(kink.found) && earlier {
        return kink;
    }
    return Crossing(SOUGHT_STOP, cubic_through(start, end), one);
}

// The first impact or overturning in a span of `h` seconds, while the block rocks.
fn angles_in(corner: Corner, y: Motion, y1: Motion, k1: Rates, k_end: Rates, h: real) -> Crossing {
    let zero: real = 0.0;
    let one: real = 1.0;
    let phi0 = corner.side * y.phi;
    let phi1 = corner.side * y1.phi;
    let dphi0 = corner.side * y.dphi;
    let dphi1 = corner.side * y1.dphi;
    var upper = one;
    var impact = phi1 < 0.0;
    var over = phi1 >= corner.overturn;
    // Two crossings in one span: the extremum of the angle lies between them.
    if !(impact || over) && crosses(dphi0, dphi1) {
        let at = dphi0 / (dphi0 - dphi1);
        let extremum = hermite(phi0, h * dphi0, phi1, h * dphi1, at);
        impact = extremum < 0.0;
        over = extremum >= corner.overturn;
        upper = select(one, at, impact || over);
    }
    if !(impact || over) {
        return Crossing(NOTHING_SOUGHT, Cubic(-one, zero, zero, zero), one);
    }
    let sense = select(corner.side, -corner.side, impact);
    let goal = select(corner.overturn, zero, impact);
    let start = angle_guard(sense, goal, y, k1, h);
    let end = angle_guard(sense, goal, y1, k_end, h);
    let found = select(SOUGHT_OVERTURNING, SOUGHT_IMPACT, impact);
    return Crossing(found, cubic_through(start, end), upper);
}

// The first uplift in a span, while the block stands.
fn uplifts_in(start: Contact, mid: Contact, end: Contact) -> Crossing {
    let zero: real = 0.0;
    let one: real = 1.0;
    if !(highest_moment(start, mid, end) > 0.0) {
        return Crossing(NOTHING_SOUGHT, Cubic(-one, zero, zero, zero), one);
    }
    let left_end = uplift_moment(model.left, end);
    let right_end = uplift_moment(model.right, end);
    let by_left =
        moment_rises(uplift_moment(model.left, start), uplift_moment(model.left, mid), left_end);
    let by_right =
        moment_rises(uplift_moment(model.right, start), uplift_moment(model.right, mid), right_end);
    let lefts = by_left.at > 0.0;
    let rights = by_right.at > 0.0;
    if !(lefts || rights) {
        return Crossing(NOTHING_SOUGHT, Cubic(-one, zero, zero, zero), one);
    }
    // The first guess is for the moment that becomes positive first. The search itself uses the larger of the two
    // moments, whose zero is the first uplift in either case.
    let larger = left_end >= right_end;
    let earlier = by_right.at > by_left.at || (by_right.at >= by_left.at && larger);
    let by_its_left = lefts && (!rights || earlier);
    var rise = by_right;
    if by_its_left {
        rise = by_left;
    }
    return Crossing(SOUGHT_UPLIFT, rise.cubic, rise.at);
}

// The first guard in a span of `h` seconds: a kink (unless the span ends at one) or the end stop (unless it ends there), else
// a switch.
fn crossing_in(
    cell: Cell,
    corner: Corner,
    rocking: bool,
    kinked: bool,
    stopped: bool,
    y: Motion,
    stepped: Stepped,
    k1: Rates,
    k_end: Rates,
    h: real,
) -> Crossing {
    let y1 = stepped.y;
    if kinks {
        let zero: real = 0.0;
        let one: real = 1.0;
        var crossing = Crossing(NOTHING_SOUGHT, Cubic(-one, zero, zero, zero), one);
        if !kinked {
            crossing = kinks_in(y, y1, k1, k_end, h);
        }
        if stops && !stopped {
            crossing = stops_in(cell, crossing, y, y1, k1, k_end, h);
        }
        if is_any(crossing.found) {
            return crossing;
        }
    }
    if rocking {
        return angles_in(corner, y, y1, k1, k_end, h);
    }
    return uplifts_in(contact_of(k1), stepped.mid, contact_of(k_end));
}

// The guard at the end of a trial: the one that is searched for, or else an impact. Its slope is over the span of `h`
// seconds.
fn sample_of(
    sought: Sought,
    cell: Cell,
    corner: Corner,
    y: Motion,
    y1: Motion,
    k_end: Rates,
    h: real,
) -> GuardSample {
    let zero: real = 0.0;
    let sense = select(-corner.side, corner.side, sought == SOUGHT_OVERTURNING);
    let goal = select(zero, corner.overturn, sought == SOUGHT_OVERTURNING);
    var sample = angle_guard(sense, goal, y1, k_end, h);
    if sought == SOUGHT_UPLIFT {
        sample.value = largest_uplift_moment(contact_of(k_end));
        sample.rounding = moment_rounding(contact_of(k_end));
    }
    if is_kink(sought) {
        sample = kink_guard(sought == SOUGHT_KINK_Z, y, y1, k_end, h);
    }
    if stops && sought == SOUGHT_STOP {
        sample = end_stop_guard(cell, y1, k_end, h);
    }
    return sample;
}
