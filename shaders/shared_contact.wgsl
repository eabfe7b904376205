// The full contact that cells share: where it takes a cell before the cell lifts.
// Twin: src/cells/contact/shared_contact.rs.

// The shared motions. Twin: src/cells/contact/motions.rs.
@group(0) @binding(12) var<storage, read> motions: array<real>;

const DISPLACEMENT = 0u;
const VELOCITY = 1u;
const ACCELERATION = 2u;
const LOWER = 3u;
const TOP = 4u;
const LEAST_SO_FAR = 5u;
const Z = 5u;
const UPPER = 6u;
const UPPER_SO_FAR = 7u;
const MINUS_LOWER_SO_FAR = 8u;
const MAGNITUDE_SO_FAR = 9u;
const LEAST = 6u;
const MAGNITUDE = 10u;
const EIGHTHS_V = 7u;
const QUARTERS_H = 11u;
const BOTTOM = 14u;
const LOWER_SO_FAR = 15u;

// The gap of v that stands for a gap of u: the last one where the motion of v is shorter.
fn gap_of_v(gap: u32, last_v: u32) -> u32 {
    return min(gap, max(last_v, 1u) - 1u);
}

// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
// (14) is between two bounds, and Y above one.
fn lifts(lever: real, upper: real, lower: real, lower_y: real) -> bool {
    // A negative lever turns the bounds about.
    let one = lever * upper;
    let other = lever * lower;
    return max(one, other) > model.left.arm * lower_y
        || max(-one, -other) > model.right.arm * lower_y;
}

// The first gap in which a cell may lift by the largest bounds of X and the least of Y so far, which do not
// fall and do not rise from gap to gap; or the last sample, which ends no gap. It lifts in no gap before.
fn first_beyond(h: u32, v: u32, last: u32, last_v: u32, lever: real) -> u32 {
    let upper_so_far = h + UPPER_SO_FAR * tile.across.more;
    let minus_lower_so_far = h + MINUS_LOWER_SO_FAR * tile.across.more;
    let lower_so_far = v + LOWER_SO_FAR * tile.up.more;
    var rising = model.left.arm;
    var falling = model.right.arm;
    if lever < 0.0 {
        rising = model.right.arm;
        falling = model.left.arm;
    }
    let size = abs(lever);
    var low = 0u;
    var high = last;
    while low < high {
        let gap = (low + high) / 2u;
        let lower_y = motions[lower_so_far + gap_of_v(gap, last_v)];
        if size * motions[upper_so_far + gap] > rising * lower_y
            || size * motions[minus_lower_so_far + gap] > falling * lower_y {
            high = gap;
        } else {
            low = gap + 1u;
        }
    }
    return low;
}

// The first gap in which a cell may lift, from a gap on, or the last sample.
fn first_lift(h: u32, v: u32, last: u32, last_v: u32, lever: real, first: u32) -> u32 {
    let upper = h + UPPER * tile.across.more;
    let lower = h + LOWER * tile.across.more;
    let lower_y = v + LOWER * tile.up.more;
    var sample = first;
    while sample < last {
        let y = motions[lower_y + gap_of_v(sample, last_v)];
        if lifts(lever, motions[upper + sample], motions[lower + sample], y) {
            break;
        }
        sample += 1u;
    }
    return sample;
}

// Takes a cell from its start to the first gap in which it may lift, or to the end of the excitation.
fn full_contact(place: Place, scale: real, cell: Cell, state: ptr<function, State>) {
    let zero: real = 0.0;
    let first_h = entry(tile.across, place);
    let first_v = entry(tile.up, place);
    let h = words[first_h];
    let v = tile.up_values + words[first_v];
    let all_h = tile.across.more;
    let all_v = tile.up.more;
    // u is A_h times what it is for A_h = 1.
    let lever = model.height * scale;
    let size = abs(scale);
    // The last sample ends no gap. A motion of v at rest is as long as it is asked for.
    let last = words[first_h + 1u] - h - 1u;
    let last_v = words[first_v + 1u] - words[first_v] - 1u;
    let first = first_beyond(h, v, last, last_v, lever);
    let sample = first_lift(h, v, last, last_v, lever, first);
    var friction = zero;
    if tile.still == 1u {
        let y = motions[v + ACCELERATION * all_v];
        if sample > 0u && y > 0.0 {
            friction = size * motions[h + MAGNITUDE_SO_FAR * all_h + sample - 1u] / y;
        }
    } else if forces {
        friction = at_samples(h, v, last_v, size, sample);
        friction = crests(h, v, last_v, size, sample, friction);
    }
    let at = min(sample, last_v);
    var z = motions[h + Z * all_h + sample];
    if scale < 0.0 {
        z = -z;
    }
    (*state).motion = Motion(
        scale * motions[h + DISPLACEMENT * all_h + sample],
        scale * motions[h + VELOCITY * all_h + sample],
        motions[v + DISPLACEMENT * all_v + at],
        motions[v + VELOCITY * all_v + at],
        z,
        zero,
        zero,
    );
    (*state).max_u = size * motions[h + TOP * all_h + sample];
    (*state).least_v = motions[v + BOTTOM * all_v + at];
    (*state).most_v = motions[v + TOP * all_v + at];
    let least = motions[v + LEAST_SO_FAR * all_v + at];
    if least < (*state).min_contact {
        (*state).min_contact = least;
    }
    (*state).friction = friction;
    (*state).step = min(sample * cell.substeps, cell.steps_forced);
    if (*state).step >= cell.steps {
        (*state).status = FINISHED;
    }
}
