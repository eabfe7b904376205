// One cell's numbers, and the ground's accelerations. Twin: src/model/excitation.rs.

struct Cell {
    post_yield: real,
    hysteretic: real,
    damping_h: real,
    inverse_yield: real,
    stiffness_v: real,
    damping_v: real,
    amplitude_h: real,
    amplitude_v: real,
    phase_step: real,
    step_forced: real,
    step_free: real,
    rest_speed: real,
    yield_energy: real,
    deflection: real,
    reach_h: real,
    reach_v: real,
    steps_forced: u32,
    steps: u32,
    substeps: u32,
    // Number of the body.
    body: u32,
}

struct Ground {
    h: real,
    v: real,
}

// sin(2 pi tau) for 0 <= tau <= 1 (in the twin: src/model/real.rs).
fn pulse_sine(tau: real) -> real {
    let two_pi: real = 6.283185307179586;
    let quarter = select(select(tau, 0.5 - tau, tau > 0.25), tau - 1.0, tau > 0.75);
    return sine(two_pi * quarter);
}
