// The isolated base: Bouc-Wen horizontally, Kelvin-Voigt vertically.
// Twin: src/model/isolation.rs.

override isolated_h: bool = true;
override isolated_v: bool = true;
override kinks: bool = true;
override yields: bool = true;
override bouc_wen_n: u32 = 2u;

override follows: bool = false;
override stops: bool = false;
override hardens: bool = false;

// 1/g, s^2/m.
const INVERSE_GRAVITY = 0.1019367991845056;

// The side on which the base is against its end stop, +1 or -1, zero where it is not; as it is where a span begins.
var<private> stop: real;

struct Support {
    f_h: real,
    f_v: real,
}

// The support's two accelerations, (10a) over M_t and (10b) over M_v.
fn support(cell: Cell, y: Motion, ground: Ground) -> Support {
    var f_h = ground.h;
    if isolated_h {
        var spring = cell.horizontal.post_yield * y.u;
        if yields {
            spring = spring + cell.horizontal.hysteretic * y.z;
        }
        f_h = -(spring + cell.horizontal.damping_h * y.du);
    }
    var f_v = ground.v + model.gravity;
    if isolated_v {
        // v is measured from the static position, where the spring carries the weight.
        f_v = model.gravity - (cell.vertical.stiffness_v * y.v + cell.vertical.damping_v * y.dv);
    }
    return with_devices(cell, y, ground, Support(f_h, f_v));
}

// The same with the laws of devices.
fn with_devices(cell: Cell, y: Motion, ground: Ground, base: Support) -> Support {
    let zero: real = 0.0;
    var f_h = base.f_h;
    var f_v = base.f_v;
    if hardens {
        f_v = f_v - cell.vertical.hardening_v * y.v * y.v * y.v;
    }
    if follows {
        let pressed = pressure(f_v, ground);
        let held = f_h + pendulum_slope(cell, y) * (model.gravity - pressed);
        // Without pressure the force is zero, and not the rounding error of a difference.
        f_h = select(-(cell.horizontal.damping_h * y.du), held, pressed > 0.0);
    }
    if stops {
        f_h = f_h - stop * stop_force(cell, stop, y);
    }
    return Support(f_h, f_v);
}

// The force of a pendulum over the one that presses on it: u/R_d + mu_d z.
fn pendulum_slope(cell: Cell, y: Motion) -> real {
    var force = cell.horizontal.post_yield * y.u;
    if yields {
        force = force + cell.horizontal.hysteretic * y.z;
    }
    return force * INVERSE_GRAVITY;
}

// The force that presses on the horizontal device over M_t, where the block is in full contact or the base is
// isolated vertically.
fn pressure(f_v: real, ground: Ground) -> real {
    let below = ground.v + model.gravity;
    // The share M_v/M_t of the mass is above the spring. Where the vertical direction is locked f_v is that of the
    // ground.
    let above = model.mu_h * model.inverse_mu_v;
    return below + above * (f_v - below);
}

// The vertical force that the base carries over M, m/s^2, from the normal contact force over M and the vertical
// accelerations, with gravity, of the upper plate and of the ground: m_v moves with the upper plate, m_h with the ground.
// A vertical isolation alone stands on m_h, and without isolation the block stands on the ground.
fn base_load(normal: real, plate: real, ground: real) -> real {
    var load = normal;
    // M_v/M, where the plate m_v moves otherwise than the ground.
    var above: real = 1.0;
    if isolated_v {
        above = model.inverse_mu_v;
        load = load + (above - 1.0) * plate;
    }
    if isolated_h {
        load = load + (model.inverse_mu_h - above) * ground;
    }
    return load;
}

// The force of the end stop over M_t against the base's displacement on a side, positive where it is compressed.
fn stop_force(cell: Cell, side: real, y: Motion) -> real {
    return cell.horizontal.stop_damping * side * y.du + cell.horizontal.stop_stiffness * (side * y.u - cell.horizontal.stop_gap);
}

// The guard of the end stop: positive where the base is beyond the gap and the stop's force is a push.
fn stop_guard(cell: Cell, y: Motion) -> real {
    let side = side_of(y.u);
    let pushed = cell.horizontal.stop_stiffness * (side * y.u - cell.horizontal.stop_gap);
    return min(pushed, stop_force(cell, side, y));
}

// +1 for a displacement above zero, -1 for others.
fn side_of(u: real) -> real {
    let one: real = 1.0;
    return select(-one, one, u > 0.0);
}

// The side on which the base is against its end stop; zero where it is not.
fn stop_side(cell: Cell, y: Motion) -> real {
    let zero: real = 0.0;
    return select(zero, side_of(y.u), stop_guard(cell, y) > 0.0);
}

// dz/dt of (11) with A_h = 1 and beta_h = gamma_h = 1/2.
fn hysteretic_rate(cell: Cell, y: Motion) -> real {
    let rate = y.du * cell.horizontal.inverse_yield;
    if (y.du > 0.0) != (y.z > 0.0) {
        return rate;
    }
    let magnitude = abs(y.z);
    var power = magnitude * magnitude;
    if bouc_wen_n != 2u {
        // The power is a product of repeated squares, because a driver may limit the iterations of a loop in a
        // shader.
        power = 1.0;
        var square = magnitude;
        for (var n = bouc_wen_n; n > 0u; n = n >> 1u) {
            if (n & 1u) == 1u {
                power = power * square;
            }
            square = square * square;
        }
    }
    return rate * (1.0 - power);
}
