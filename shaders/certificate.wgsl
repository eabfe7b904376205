// The certificate: the proof, by energy, that all results of a cell are final. Twin:
// src/stepping/certificate.rs, which derives it.

override certificate: bool = false;

const STEPS_A_TRY = 16u;
const MARGIN = 1.0e-3;
const SIXTH = 0.16666666666666666;
const TWELFTH = 0.08333333333333333;
const THIRTIETH = 0.03333333333333333;

// P - H, the height that the centre of mass has gained at an angle phi >= 0 about a corner, m: no less
// than this, by sin phi >= phi - phi^3/6 and 1 - cos phi <= phi^2/2 - phi^4/24 + phi^6/720.
fn least_rise(corner: Corner, phi: real) -> real {
    let t = phi * phi;
    let arm = corner.arm * (1.0 - t * SIXTH);
    let height = model.height * (1.0 - t * TWELFTH * (1.0 - t * THIRTIETH));
    return phi * (arm - 0.5 * phi * height);
}

// Twice the energies of the base over M_t, from rest.
fn base_energy_h(cell: Cell, y: Motion) -> real {
    let zero: real = 0.0;
    if !isolated_h {
        return zero;
    }
    let base_h = y.du * y.du + cell.horizontal.post_yield * y.u * y.u;
    if yields {
        return base_h + cell.horizontal.yield_energy * y.z * y.z;
    }
    return base_h;
}

// Twice those over M_v; gravity is in them.
fn base_energy_v(cell: Cell, y: Motion) -> real {
    let zero: real = 0.0;
    if !isolated_v {
        return zero;
    }
    let square = y.v * y.v;
    let linear = y.dv * y.dv + cell.vertical.stiffness_v * square;
    if hardens {
        return linear + 0.5 * cell.vertical.hardening_v * square * square;
    }
    return linear;
}

// The most of |X|, in full contact, for twice an energy over M_t that is left to it, by Cauchy's inequality.
fn most_x(cell: Cell, root_h: real) -> real {
    return cell.horizontal.reach_h * root_h;
}

// The same of |Y - g|; `root_v` is the root of twice an energy over M_v.
fn most_y(cell: Cell, root_v: real) -> real {
    let swing = cell.vertical.reach_v * root_v;
    if hardens {
        let ratio = root_v / cell.vertical.stiffness_v;
        return swing * (1.0 + cell.vertical.hardening_v * ratio * ratio);
    }
    return swing;
}

// True where energies that are left in the base reach no further than the largest |u| and |v|, or where nobody asks for
// these.
fn within(cell: Cell, state: State, left_h: real, left_v: real) -> bool {
    // The end stop is out of reach.
    if stops && !(cell.horizontal.post_yield * cell.horizontal.stop_gap * cell.horizontal.stop_gap >= left_h) {
        return false;
    }
    if !displacements {
        return true;
    }
    if isolated_h && !(cell.horizontal.post_yield * state.extremes.max_u * state.extremes.max_u >= left_h) {
        return false;
    }
    if isolated_v {
        // A base at rest moves by the rounding error of the weight that it carries. With the deflection
        // |v| is largest below, or, of a swing of twice the deflection and more, above.
        let rounding_allowance = real(EVENT_TOLERANCE) * cell.vertical.deflection;
        let way = max(-state.extremes.least_v, state.extremes.most_v - 2.0 * cell.vertical.deflection) + rounding_allowance;
        return cell.vertical.stiffness_v * way * way >= left_v;
    }
    return true;
}

// True where all results of the cell that are asked for are final; the excitation must be over, and a block that rocks have
// just had an impact.
fn is_final(cell: Cell, state: State) -> bool {
    let zero: real = 0.0;
    let more: real = 1.0 + MARGIN;
    let y = state.motion;
    let rocking = state.mode != FULL_CONTACT;
    let base_h = base_energy_h(cell, y);
    let base_v = base_energy_v(cell, y);
    // What is left of them at most. A block in full contact may yet lift, and the base's energies are
    // then the least that each can be.
    var left_h = more * base_h;
    var left_v = more * base_v;
    if !(rocking || within(cell, state, left_h, left_v)) {
        return false;
    }
    // In full contact u and v are not coupled: |X| and |Y - g| by Cauchy's inequality.
    var x_most = zero;
    var y_swing = zero;
    var stays = !rocking;
    if stays {
        x_most = most_x(cell, sqrt(left_h));
        y_swing = most_y(cell, sqrt(left_v));
        stays = model.least_arm * (model.gravity - y_swing) > model.height * x_most;
    }
    var energy = zero;
    if !stays {
        // Otherwise the whole energy over M, in whichever coordinate.
        energy = 0.5 * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
        if rocking {
            let corner = pivot(state.mode);
            // At an impact phi = 0: P = H and Q = s b.
            let arm = corner.side * corner.arm;
            let push = arm * y.dv - model.height * y.du + 0.5 * corner.inertia * y.dphi;
            energy = energy + push * y.dphi;
        }
        energy = model.impact_gain * more * energy;
        left_h = 2.0 * model.mu_h * energy;
        left_v = 2.0 * model.mu_v * energy;
        let small = state.uplifts > 0u && energy < model.topple_energy;
        if !(small && within(cell, state, left_h, left_v)) {
            return false;
        }
        if angles {
            let bound_left = model.gravity * least_rise(model.left, state.extremes.max_phi_left);
            let bound_right = model.gravity * least_rise(model.right, state.extremes.max_phi_right);
            if !(energy <= bound_left && energy <= bound_right) {
                return false;
            }
        }
        x_most = most_x(cell, sqrt(left_h));
        y_swing = most_y(cell, sqrt(left_v));
    }
    if accelerations {
        // In full contact plate and block move alike.
        let least = more * min(state.extremes.acc_plate, state.extremes.acc_block);
        let least_total = more * min(state.extremes.acc_plate_total, state.extremes.acc_block_total);
        let y_most = model.gravity + y_swing;
        let held = least >= x_most && least_total * least_total >= x_most * x_most + y_most * y_most;
        let load = base_load(y_most, y_most, model.gravity);
        if !(stays && held && more * state.extremes.base_load >= load) {
            return false;
        }
    }
    if !forces {
        return true;
    }
    return forces_are_final(state, stays, x_most, y_swing, energy);
}

// True where the contact forces pass no extreme: of a block that stays in full contact, or of one with an energy over M
// left to its rotation.
fn forces_are_final(state: State, stays: bool, x_most: real, y_swing: real, energy: real) -> bool {
    let zero: real = 0.0;
    let one: real = 1.0;
    let margin: real = MARGIN;
    let more: real = 1.0 + MARGIN;
    // The least normal force and the largest share of the shear.
    let share = select(model.normal_share, one, stays);
    let turn = select(energy, zero, stays);
    let by_shear = select(model.normal_by_shear * x_most, zero, stays);
    let by_normal = select(model.shear_by_normal * (model.gravity + y_swing), zero, stays);
    let normal = share * (model.gravity - y_swing) - by_shear - model.normal_by_turn * turn;
    let shear = x_most + by_normal + model.shear_by_turn * turn;
    let pressed = normal >= state.extremes.min_contact - margin * abs(state.extremes.min_contact);
    return pressed && more * state.extremes.friction * normal >= shear;
}
