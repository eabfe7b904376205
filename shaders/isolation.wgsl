// The isolated base: Bouc-Wen horizontally, Kelvin-Voigt vertically.
// Twin: src/model/isolation.rs.

override isolated_h: bool = true;
override isolated_v: bool = true;
override kinks: bool = true;
override yields: bool = true;
override bouc_wen_n: u32 = 2u;

struct Support {
    f_h: real,
    f_v: real,
}

// The support's two accelerations, (10a) over M_t and (10b) over M_v.
fn support(cell: Cell, y: Motion, ground: Ground) -> Support {
    var f_h = ground.h;
    if isolated_h {
        var spring = cell.post_yield * y.u;
        if yields {
            spring = spring + cell.hysteretic * y.z;
        }
        f_h = -(spring + cell.damping_h * y.du);
    }
    var f_v = ground.v + model.gravity;
    if isolated_v {
        // v is counted from the static position, where the spring carries the weight.
        f_v = model.gravity - (cell.stiffness_v * y.v + cell.damping_v * y.dv);
    }
    return Support(f_h, f_v);
}

// dz/dt of (11) with A_h = 1 and beta_h = gamma_h = 1/2.
fn hysteretic_rate(cell: Cell, y: Motion) -> real {
    let rate = y.du * cell.inverse_yield;
    if (y.du > 0.0) != (y.z > 0.0) {
        return rate;
    }
    let magnitude = abs(y.z);
    var power = magnitude * magnitude;
    if bouc_wen_n != 2u {
        // By squares: a driver may bound the iterations of a shader's loops.
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
