// One cell's numbers and the ground under it. Twin: src/model/excitation.rs.

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
    padding: u32,
}

struct Ground {
    h: real,
    v: real,
}

override recorded: bool = false;

// Samples of the record.
@group(0) @binding(5) var<storage, read> record: array<Ground>;

// sin(2 pi tau) for 0 <= tau <= 1 (in the twin: src/model/real.rs).
fn pulse_sine(tau: real) -> real {
    let two_pi: real = 6.283185307179586;
    if tau > 0.75 {
        return sine(two_pi * (tau - 1.0));
    }
    if tau > 0.25 {
        return sine(two_pi * (0.5 - tau));
    }
    return sine(two_pi * tau);
}

// Length of a step, s.
fn step_length(cell: Cell, step: u32) -> real {
    if step < cell.steps_forced {
        return cell.step_forced;
    }
    return cell.step_free;
}

// The ground at a fraction of a step: the one-sine pulse (22), or the record, linear between its
// samples.
fn ground_at(cell: Cell, step: u32, fraction: real) -> Ground {
    if step >= cell.steps_forced {
        return Ground(real(0.0), real(0.0));
    }
    if recorded {
        let sample = step / cell.substeps;
        let part = step - sample * cell.substeps;
        let share = (real(part) + fraction) * cell.phase_step;
        let before = record[sample];
        let after = record[sample + 1u];
        return Ground(
            before.h + share * (after.h - before.h),
            before.v + share * (after.v - before.v),
        );
    }
    let wave = pulse_sine((real(step) + fraction) * cell.phase_step);
    return Ground(cell.amplitude_h * wave, cell.amplitude_v * wave);
}
