// The motion of the ground under a cell, one forcing segment at a time: steps of equal length under a ground motion
// of one form (the pulse, a gap between two samples of a record, or rest). Twin: src/stepping/forcing.rs.

override recorded: bool = false;

// The most steps of a segment.
const MOST_STEPS = 1048576u;

// Numbers that a cell already has take no registers of their own here: the length of a step is a function, and the
// numbers of the pulse stay after its end, where `ground_at` does not use them.
struct Forcing {
    done: real,
    steps: real,
    phase_start: real,
    phase_step: real,
    base: Ground,
    rise: Ground,
    forced: bool,
}

// The length of a step, s.
fn step_length(cell: Cell, forcing: Forcing) -> real {
    return select(cell.steps.step_free, cell.steps.step_forced, forcing.forced);
}

// Samples of the record; the tables of numbers follow, which the kernel that makes cells reads.
@group(0) @binding(5) var<storage, read> record: array<Ground>;

// The acceleration of the ground at a fraction of the step: the pulse (22), or the record, linear between its
// samples.
fn ground_at(cell: Cell, forcing: Forcing, fraction: real) -> Ground {
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
    let share = wave(cell, phase);
    return Ground(forcing.base.h * share, forcing.base.v * share);
}

// The segment in which a cell is after `step` steps, fewer than it has in all.
fn begin_segment(cell: Cell, step: u32) -> Forcing {
    var before: Ground;
    var after: Ground;
    if recorded && step < cell.steps.steps_forced {
        let sample = step / cell.steps.substeps;
        before = record[sample];
        after = record[sample + 1u];
    }
    return segment(cell, step, before, after);
}

// The same with the samples of the record at the start and at the end of the gap.
fn segment(cell: Cell, step: u32, before: Ground, after: Ground) -> Forcing {
    let zero: real = 0.0;
    let none = Ground(zero, zero);
    let amplitude = Ground(cell.drive.amplitude_h, cell.drive.amplitude_v);
    if step >= cell.steps.steps_forced {
        let steps = min(cell.steps.steps - step, MOST_STEPS);
        return Forcing(zero, real(steps), zero, cell.steps.phase_step, amplitude, none, false);
    }
    if recorded {
        let sample = step / cell.steps.substeps;
        let start = Ground(amplitude.h * before.h, amplitude.v * before.v);
        let rise = Ground(
            amplitude.h * (after.h - before.h),
            amplitude.v * (after.v - before.v),
        );
        let first = sample * cell.steps.substeps;
        let done = real(step - first);
        let steps = real(cell.steps.substeps);
        return Forcing(done, steps, zero, cell.steps.phase_step, start, rise, true);
    }
    let first = step - step % MOST_STEPS;
    let steps = min(cell.steps.steps_forced - first, MOST_STEPS);
    return Forcing(
        real(step - first),
        real(steps),
        real(first) * cell.steps.phase_step,
        cell.steps.phase_step,
        amplitude,
        none,
        true,
    );
}
