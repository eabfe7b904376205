// The equations of motion. Twin: src/model/dynamics.rs.

struct Rates {
    du: real,
    ddu: real,
    dv: real,
    ddv: real,
    dz: real,
    dphi: real,
    ddphi: real,
    normal: real,
    shear: real,
}

// The force between block and base over M.
struct Contact {
    shear: real,
    normal: real,
}

// The contact force that belongs to the rates.
fn contact_of(k: Rates) -> Contact {
    return Contact(k.shear, k.normal);
}

// The lever of the centre of mass about a corner.
struct Lever {
    p: real,
    q: real,
}

// P and Q at an angle.
fn lever_at(corner: Corner, phi: real) -> Lever {
    let height = model.height;
    let sin_phi = sine(phi);
    let cos_phi = cosine(phi);
    let arm = corner.side * corner.arm;
    return Lever(height * cos_phi + arm * sin_phi, arm * cos_phi - height * sin_phi);
}

// The rates of the motion: (5) in full contact, (9) while the block rocks.
fn rates(cell: Cell, corner: Corner, rocking: bool, y: Motion, ground: Ground) -> Rates {
    let base = support(cell, y, ground);
    // X and Y, the base's absolute accelerations (Y with g).
    var x_base = base.f_h;
    var y_base = base.f_v;
    var ddphi: real = 0.0;
    var normal = base.f_v;
    var shear = base.f_h;
    if rocking {
        let lever = lever_at(corner, y.phi);
        let p = lever.p;
        let q = lever.q;
        let w = y.dphi * y.dphi;
        let mu_p = model.mu_h * p;
        let mu_q = model.mu_v * q;
        var push_h = base.f_h + model.mu_h * q * w;
        let push_v = base.f_v + model.mu_v * p * w;
        let inertia = corner.inertia - mu_p * p - mu_q * q;
        ddphi = (p * push_h - q * push_v) / inertia;
        if follows && !isolated_v {
            // The rotation changes the force on the pendulum, too: the angular acceleration stands on both sides of
            // (9a).
            let zero: real = 0.0;
            let slope = pendulum_slope(cell, y);
            let weight = base.f_v;
            let rest = push_h + slope * max(weight, zero);
            let still = weight - mu_p * w;
            let moment = p * (rest - slope * still) - q * push_v;
            let pressed = moment / (inertia + slope * mu_p * q);
            let pressure = still + model.mu_h * q * pressed;
            let held = pressure > 0.0;
            ddphi = select((p * rest - q * push_v) / inertia, pressed, held);
            push_h = rest - slope * max(pressure, zero);
        }
        x_base = push_h + mu_p * ddphi;
        y_base = push_v - mu_q * ddphi;
        shear = x_base - p * ddphi - q * w;
        normal = y_base + q * ddphi - p * w;
    }
    var ddu: real = 0.0;
    var dz: real = 0.0;
    if isolated_h {
        ddu = x_base - ground.h;
    }
    if yields {
        dz = hysteretic_rate(cell, y);
    }
    var ddv: real = 0.0;
    if isolated_v {
        ddv = y_base - ground.v - model.gravity;
    }
    return Rates(y.du, ddu, y.dv, ddv, dz, y.dphi, ddphi, normal, shear);
}

// The uplift condition (14) about a corner as a moment over M, positive where the block lifts.
fn uplift_moment(corner: Corner, contact: Contact) -> real {
    return corner.side * model.height * contact.shear - corner.arm * contact.normal;
}

// The larger of the two uplift moments: positive where the block lifts about either corner.
fn largest_uplift_moment(contact: Contact) -> real {
    let left = uplift_moment(model.left, contact);
    let right = uplift_moment(model.right, contact);
    return max(left, right);
}
