// One trial by the classical Runge-Kutta method. Twin: src/stepping/rk4.rs.

// Where a trial ends.
struct Stepped {
    y: Motion,
    mid: Contact,
    mid_ddu: real,
    mid_ddv: real,
    k4: Rates,
}

// The motion after a time `h` at the rates `k`.
fn shift(y: Motion, k: Rates, h: real) -> Motion {
    return Motion(
        y.u + h * k.du,
        y.du + h * k.ddu,
        y.v + h * k.dv,
        y.dv + h * k.ddv,
        y.z + h * k.dz,
        y.phi + h * k.dphi,
        y.dphi + h * k.ddphi,
    );
}

// The motion a time `back` before the end `y` of a span of `h` seconds, whose rates are `k1` at the start
// and `k` at the end and change evenly: to second order in `back`.
fn shift_back(y: Motion, k1: Rates, k: Rates, back: real, h: real) -> Motion {
    let half = 0.5 * back * back;
    let change = half / h;
    return Motion(
        y.u - back * k.du + half * k.ddu,
        y.du - back * k.ddu + change * (k.ddu - k1.ddu),
        y.v - back * k.dv + half * k.ddv,
        y.dv - back * k.ddv + change * (k.ddv - k1.ddv),
        y.z - back * k.dz + change * (k.dz - k1.dz),
        y.phi - back * k.dphi + half * k.ddphi,
        y.dphi - back * k.ddphi + change * (k.ddphi - k1.ddphi),
    );
}

// Steps over `h` seconds from the motion `y` with rates `k1`, the ground as it is halfway and at the
// end.
fn rk4(
    cell: Cell,
    corner: Corner,
    rocking: bool,
    y: Motion,
    k1: Rates,
    h: real,
    ground_mid: Ground,
    ground_end: Ground,
) -> Stepped {
    let half = 0.5 * h;
    let k2 = rates(cell, corner, rocking, shift(y, k1, half), ground_mid);
    let k3 = rates(cell, corner, rocking, shift(y, k2, half), ground_mid);
    let k4 = rates(cell, corner, rocking, shift(y, k3, h), ground_end);
    let sixth = 0.16666666666666666 * h;
    let end = Motion(
        y.u + sixth * (k1.du + 2.0 * (k2.du + k3.du) + k4.du),
        y.du + sixth * (k1.ddu + 2.0 * (k2.ddu + k3.ddu) + k4.ddu),
        y.v + sixth * (k1.dv + 2.0 * (k2.dv + k3.dv) + k4.dv),
        y.dv + sixth * (k1.ddv + 2.0 * (k2.ddv + k3.ddv) + k4.ddv),
        y.z + sixth * (k1.dz + 2.0 * (k2.dz + k3.dz) + k4.dz),
        y.phi + sixth * (k1.dphi + 2.0 * (k2.dphi + k3.dphi) + k4.dphi),
        y.dphi + sixth * (k1.ddphi + 2.0 * (k2.ddphi + k3.ddphi) + k4.ddphi),
    );
    // Halfway the displacement of one stage lags by h^2/8 of its acceleration and that of the other
    // leads by as much.
    let mid = Contact(0.5 * (k2.shear + k3.shear), 0.5 * (k2.normal + k3.normal));
    return Stepped(end, mid, 0.5 * (k2.ddu + k3.ddu), 0.5 * (k2.ddv + k3.ddv), k4);
}

// Value at the fraction `at` of the cubic through two ends with their slopes over `h`.
fn hermite(x0: real, slope0: real, x1: real, slope1: real, at: real) -> real {
    let rise = x1 - x0;
    let c2 = 3.0 * rise - 2.0 * slope0 - slope1;
    let c3 = slope0 + slope1 - 2.0 * rise;
    return x0 + at * (slope0 + at * (c2 + at * c3));
}
