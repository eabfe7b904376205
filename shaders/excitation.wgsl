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
    envelope: real,
    carrier: real,
    stop_gap: real,
    stop_stiffness: real,
    stop_damping: real,
    stop_rate: real,
    hardening_v: real,
    steps_forced: u32,
    steps: u32,
    substeps: u32,
    // The number of the body.
    body: u32,
}

struct Ground {
    h: real,
    v: real,
}
