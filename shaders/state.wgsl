// What a cell carries from step to step, and its extremes so far. Twin: src/stepping/state.rs.

const RUNNING = 0u;
const FINISHED = 1u;
const OVERTURNED_LEFT = 2u;
const OVERTURNED_RIGHT = 3u;
const EVENT_LIMIT = 4u;
const DIVERGED = 5u;
const PROVED = 6u;

struct State {
    motion: Motion,
    extremes: Extremes,
    uplift_fraction: real,
    end_fraction: real,
    mode: u32,
    step: u32,
    impacts: u32,
    uplifts: u32,
    uplift_step: u32,
    status: u32,
}

// Largest |phi| that sine and cosine hold for, rad.
const PHI_RANGE = 1.65;
// Largest sum of |u|, |v|, |z| and |phi| of a valid motion.
const SIZE_RANGE = 1.0e4;

// True where a motion is in the range of what a block and its base can do.
fn is_finite(y: Motion) -> bool {
    let size = abs(y.u) + abs(y.v) + abs(y.z) + abs(y.phi);
    return size < SIZE_RANGE && abs(y.phi) <= PHI_RANGE;
}
