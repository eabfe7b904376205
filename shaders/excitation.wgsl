// One cell's numbers, and the ground's accelerations. Twin: src/model/excitation.rs.

// The numbers of a cell in groups, each by the parameters that it depends on; finite: 1 where all are finite.
struct Horizontal {
    post_yield: real,
    hysteretic: real,
    damping_h: real,
    inverse_yield: real,
    yield_energy: real,
    reach_h: real,
    stop_gap: real,
    stop_stiffness: real,
    stop_damping: real,
    stop_rate: real,
    finite: real,
}

struct Vertical {
    stiffness_v: real,
    damping_v: real,
    deflection: real,
    reach_v: real,
    hardening_v: real,
    finite: real,
}

struct Drive {
    amplitude_h: real,
    amplitude_v: real,
    scale: real,
    tilt: real,
    envelope: real,
    carrier: real,
    finite: real,
}

struct Steps {
    phase_step: real,
    step_forced: real,
    step_free: real,
    rest_speed: real,
    steps_forced: u32,
    steps: u32,
    substeps: u32,
    finite: u32,
}

struct Cell {
    horizontal: Horizontal,
    vertical: Vertical,
    drive: Drive,
    steps: Steps,
    // The number of the body.
    body: u32,
    padding: u32,
}

struct Ground {
    h: real,
    v: real,
}
