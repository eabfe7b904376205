// The proof that nothing more will happen. Twin: src/integrate/certificate.rs.

override certificate: bool = false;

const TRIES = 15u;
const MARGIN = 1.0e-3;

// True where it is time to try: the excitation is over.
fn is_due(cell: Cell, state: State) -> bool {
    return certificate && state.step >= cell.steps_forced && (state.step & TRIES) == 0u;
}

// P - H: height that the centre of mass has gained at phi about a corner, m.
fn rise(corner: Corner, phi: real) -> real {
    // H (1 - cos phi) by the half angle, for 1 - cos phi of a small phi is all rounding.
    let half_sine = sine(0.5 * phi);
    return corner.side * corner.arm * sine(phi) - 2.0 * model.height * half_sine * half_sine;
}

// Ends the cell if all that it tells is final.
fn certify(cell: Cell, state: ptr<function, State>) {
    let more: real = 1.0 + MARGIN;
    let y = (*state).motion;
    // Twice the energies of the base over M_t and M_v, from rest; the vertical one holds gravity.
    var base_h: real = 0.0;
    if isolated_h {
        base_h = y.du * y.du + cell.post_yield * y.u * y.u + cell.yield_energy * y.z * y.z;
    }
    var base_v: real = 0.0;
    if isolated_v {
        let lift = y.v + cell.deflection;
        base_v = y.dv * y.dv + cell.stiffness_v * lift * lift;
    }
    var left_h = more * base_h;
    var left_v = more * base_v;
    var stays = false;
    if (*state).mode == FULL_CONTACT {
        // |X| and |Y - g| by Cauchy's inequality; u and v do not see each other.
        let x_most = cell.reach_h * sqrt(left_h);
        let y_least = model.gravity - cell.reach_v * sqrt(left_v);
        stays = model.height * x_most < model.least_arm * y_least;
    }
    if !stays {
        var energy = 0.5 * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
        if (*state).mode != FULL_CONTACT {
            let corner = pivot((*state).mode);
            let lever = lever_at(corner, y.phi);
            let p = lever.p;
            let q = lever.q;
            let push = q * y.dv - p * y.du + 0.5 * corner.inertia * y.dphi;
            energy = energy + push * y.dphi + model.gravity * rise(corner, y.phi);
        }
        energy = more * energy;
        let bound_left = model.gravity * rise(model.left, (*state).max_phi_left);
        let bound_right = model.gravity * rise(model.right, -(*state).max_phi_right);
        if !(energy < model.topple_energy && energy <= bound_left && energy <= bound_right) {
            return;
        }
        left_h = 2.0 * model.mu_h * energy;
        left_v = 2.0 * model.mu_v * energy;
    }
    // The largest |u| and |v| that this can still make.
    let far_h = left_h > cell.post_yield * (*state).max_u * (*state).max_u;
    // A base at rest trembles by the rounding of its deflection.
    let up = (*state).max_v - cell.deflection + EVENT_TOLERANCE * cell.deflection;
    let far_v = up < 0.0 || left_v > cell.stiffness_v * up * up;
    if (isolated_h && far_h) || (isolated_v && far_v) {
        return;
    }
    (*state).status = PROVED;
}
