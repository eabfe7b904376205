// Rest before the last flights end: the proof that a block at rest will not lift again, and that none of the flights
// that are left out exceeds a largest or least value so far. Twin: src/stepping/early_rest.rs, which has the
// derivation.

// True where a block may come to rest now. The excitation must be over, and the block must have just had an impact.
fn rests_early(cell: Cell, state: State) -> bool {
    let more: real = 1.0 + MARGIN;
    if accelerations || hardens {
        // The accelerations of the later flights, and the rate of a spring that hardens, have no bound here.
        return false;
    }
    let y = state.motion;
    let corner = pivot(state.mode);
    // The flights, of which the first one begins now.
    let speed = abs(y.dphi);
    let d = corner.inertia
        - model.mu_h * model.height * model.height
        - model.mu_v * corner.arm * corner.arm;
    let momentum = more * d * speed;
    let flight = model.impact_gain * 0.5 * momentum * speed;
    // The base.
    let rested = come_to_rest(corner, y);
    let base_h = more * base_energy_h(cell, rested);
    let base_v = more * base_energy_v(cell, rested);
    let base = 0.5 * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
    if !(model.topple_energy > base + flight) {
        return false;
    }
    let arm = max(model.left.arm, model.right.arm);
    let root_h = sqrt(base_h) + sqrt(2.0 * model.mu_h * flight);
    let root_v = sqrt(base_v) + sqrt(2.0 * model.mu_v * flight);
    // The moment that holds the block, by the inequality of Cauchy as in the certificate.
    let x_most = most_x(cell, root_h);
    let y_swing = most_y(cell, root_v);
    let least_y = model.gravity - y_swing;
    let least = model.least_arm * least_y - model.height * x_most;
    let most = arm * (model.gravity + y_swing) + model.height * x_most;
    let fall = model.height * least_y + arm * x_most;
    // The same at this moment, about the corner with the smaller one.
    let base_now = support(cell, rested, Ground(0.0, 0.0));
    let now = model.least_arm * base_now.f_v - model.height * abs(base_now.f_h);
    let energy = flight * most / now;
    let held = 4.0 * energy * (least + 2.0 * fall);
    let radians = 2.5 * momentum * max(cell.horizontal.reach_h, cell.vertical.reach_v);
    let eta = max(model.left.eta_phi, model.right.eta_phi);
    let loss = max(1.0 - eta * eta * eta, 1.0e-6);
    if !(least > 0.0 && least >= radians && least * least >= held) {
        return false;
    }
    let angle = 2.0 * flight / sqrt(now * least);
    if angles && !(min(state.extremes.max_phi_left, state.extremes.max_phi_right) >= angle) {
        return false;
    }
    // How far the flights move the base, and how fast.
    let share = 1.25 + 0.02 * radians / (least * loss);
    let moved = model.mu_v * arm * angle * share;
    let kick = model.mu_v * arm * speed * sqrt(most / now);
    let root_v_moved = sqrt(base_v) + cell.vertical.reach_v * moved;
    if !within(cell, state, root_h * root_h, root_v_moved * root_v_moved) {
        return false;
    }
    let swing = cell.vertical.reach_v * (root_v_moved + cell.vertical.reach_v * moved) + cell.vertical.damping_v * kick;
    return !forces || forces_are_final(state, false, x_most, min(y_swing, swing), energy);
}
