// The ground under a cell, a forcing segment at a time: steps of one length under a ground of one form
// (the pulse, a gap between two samples of a record, or rest). Twin: src/stepping/forcing.rs.

override recorded: bool = false;

// Most steps of a segment.
const MOST_STEPS = 1048576u;

struct Forcing {
    step: real,
    done: real,
    steps: real,
    phase_start: real,
    phase_step: real,
    base: Ground,
    rise: Ground,
    // First step of the segment.
    first_step: u32,
    forced: bool,
}

// Samples of the record.
@group(0) @binding(5) var<storage, read> record: array<Ground>;

// The ground at a fraction of the step: the one-sine pulse (22), or the record, linear between its
// samples.
fn ground_at(forcing: Forcing, fraction: real) -> Ground {
    let zero: real = 0.0;
    if !forcing.forced {
        return Ground(zero, zero);
    }
    let phase = forcing.phase_start + (forcing.done + fraction) * forcing.phase_step;
    if recorded {
        return Ground(
            forcing.base.h + phase * forcing.rise.h,
            forcing.base.v + phase * forcing.rise.v,
        );
    }
    let wave = pulse_sine(phase);
    return Ground(forcing.base.h * wave, forcing.base.v * wave);
}

// The segment that a cell is in after `step` steps, fewer than it has in all.
fn begin_segment(cell: Cell, step: u32) -> Forcing {
    let zero: real = 0.0;
    let none = Ground(zero, zero);
    if step >= cell.steps_forced {
        let steps = min(cell.steps - step, MOST_STEPS);
        return Forcing(cell.step_free, zero, real(steps), zero, cell.phase_step, Ground(cell.amplitude_h, cell.amplitude_v), none, step, false);
    }
    if recorded {
        let sample = step / cell.substeps;
        let before = record[sample];
        let after = record[sample + 1u];
        let rise = Ground(after.h - before.h, after.v - before.v);
        let first = sample * cell.substeps;
        let done = real(step - first);
        let steps = real(cell.substeps);
        return Forcing(
            cell.step_forced,
            done,
            steps,
            zero,
            cell.phase_step,
            before,
            rise,
            first,
            true,
        );
    }
    let first = step - step % MOST_STEPS;
    let steps = min(cell.steps_forced - first, MOST_STEPS);
    return Forcing(
        cell.step_forced,
        real(step - first),
        real(steps),
        real(first) * cell.phase_step,
        cell.phase_step,
        Ground(cell.amplitude_h, cell.amplitude_v),
        none,
        first,
        true,
    );
}
