// The full contact that cells share: it takes a cell to the place where it may first lift. Twin:
// src/cells/contact/shared_contact.rs.

// The shared motions. Twin: src/cells/contact/motions.rs.
@group(0) @binding(12) var<storage, read> motions: array<real>;

const DISPLACEMENT = 0u;
const VELOCITY = 1u;
const ACCELERATION = 2u;
const LOWER = 3u;
const TOP = 4u;
// Of u; from MAGNITUDE_SO_FAR on only where contact forces are requested.
const Z = 5u;
const UPPER = 6u;
const UPPER_SO_FAR = 7u;
const MINUS_LOWER_SO_FAR = 8u;
const MAGNITUDE_SO_FAR = 9u;
const MAGNITUDE = 10u;
// Of v; from LEAST_SO_FAR on likewise.
const BOTTOM = 5u;
const LOWER_SO_FAR = 6u;
const LEAST_SO_FAR = 7u;
const LEAST = 8u;

// The gap of v that corresponds to a gap of u: the last one where the motion of v is shorter.
fn gap_of_v(gap: u32, last_v: u32) -> u32 {
    return min(gap, max(last_v, 1u) - 1u);
}

// True where a cell with this lever, H times its share of u, may lift in a gap between samples: X of (14) lies
// between two bounds, and Y lies above one.
fn lifts(lever: real, upper: real, lower: real, lower_y: real) -> bool {
    // A negative lever exchanges the two bounds.
    let one = lever * upper;
    let other = lever * lower;
    return max(one, other) > model.left.arm * lower_y
        || max(-one, -other) > model.right.arm * lower_y;
}

// The first gap in which a cell may lift by the largest bounds of X and the least bound of Y so far, which are
// monotonic from gap to gap; or the last sample, which ends no gap. The cell does not lift in an earlier gap.
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

// The first gap from a given one on in which a cell may lift, or the last sample.
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

// A number above any contact force, m/s^2, and above any friction, that every number type can hold.
const MOST = 1.0e30;

// The two motions of a cell.
struct MotionPair {
    // The first sample of u and of v.
    h: u32,
    v: u32,
    // The last sample of v, counted from its first.
    last_v: u32,
}

// The largest friction demand before a sample, if one is known.
fn friction_before(pair: MotionPair, cell: Cell, sample: u32, known: real) -> real {
    let size = abs(cell.drive.scale);
    if !forces || sample == 0u {
        return known;
    }
    if tile.still == 1u {
        let zero: real = 0.0;
        let y = motions[pair.v + ACCELERATION * tile.up.more];
        let magnitude = motions[pair.h + MAGNITUDE_SO_FAR * tile.across.more + sample - 1u];
        return select(zero, size * magnitude / y, y > 0.0);
    }
    let friction = at_samples(pair.h, pair.v, pair.last_v, size, sample, known);
    return crests(pair, cell, sample, friction);
}

// The motion at a sample, and the largest displacements up to it.
fn move_to(pair: MotionPair, scale: real, sample: u32, state: ptr<function, State>) {
    let zero: real = 0.0;
    let all_h = tile.across.more;
    let all_v = tile.up.more;
    // A motion of v at rest may be shorter: it stays as it is at its last sample.
    let h = pair.h + sample;
    let v = pair.v + min(sample, pair.last_v);
    var z = motions[h + Z * all_h];
    if scale < 0.0 {
        z = -z;
    }
    (*state).motion = Motion(
        scale * motions[h + DISPLACEMENT * all_h],
        scale * motions[h + VELOCITY * all_h],
        motions[v + DISPLACEMENT * all_v],
        motions[v + VELOCITY * all_v],
        z,
        zero,
        zero,
    );
    (*state).extremes.max_u = abs(scale) * motions[h + TOP * all_h];
    (*state).extremes.least_v = motions[v + BOTTOM * all_v];
    (*state).extremes.most_v = motions[v + TOP * all_v];
}

// The contact forces up to a sample whose friction demand is known.
fn meet_forces(pair: MotionPair, sample: u32, friction: real, state: ptr<function, State>) {
    (*state).extremes.min_contact = model.gravity;
    (*state).extremes.friction = friction;
    if forces {
        let least = motions[pair.v + min(sample, pair.last_v) + LEAST_SO_FAR * tile.up.more];
        (*state).extremes.min_contact = min(least, model.gravity);
    }
}

// Takes a cell from its start to the first gap in which it may lift, to the step at which it is final, or to the end
// of the motions. The cell is checked for being final at the same steps as in an integration of its own.
fn full_contact(place: Place, cell: Cell, state: ptr<function, State>) {
    let scale = cell.drive.scale;
    let first_h = entry(tile.across, place);
    let first_v = entry(tile.up, place);
    let h = words[first_h];
    let v = tile.up_values + words[first_v];
    // u is A_h times its value for A_h = 1.
    let lever = model.height * scale;
    // The last sample ends no gap.
    let last = words[first_h + 1u] - h - 1u;
    let last_v = words[first_v + 1u] - words[first_v] - 1u;
    let pair = MotionPair(h, v, last_v);
    let first = first_beyond(h, v, last, last_v, lever);
    let sample = first_lift(h, v, last, last_v, lever, first);
    var friction: real = 0.0;
    // A motion that is continued after the excitation has one sample per step.
    var tried = cell.steps.steps_forced + STEPS_A_TRY;
    while certificate && tried <= sample && tried < cell.steps.steps {
        move_to(pair, scale, tried, state);
        // The contact forces are treated as if they had no extreme yet: they take longer to become known.
        let most: real = MOST;
        (*state).extremes.friction = most;
        (*state).extremes.min_contact = -most;
        if is_final(cell, *state) {
            friction = friction_before(pair, cell, tried, friction);
            meet_forces(pair, tried, friction, state);
            if is_final(cell, *state) {
                (*state).step = tried;
                (*state).status = PROVED;
                return;
            }
        }
        tried += STEPS_A_TRY;
    }
    friction = friction_before(pair, cell, sample, friction);
    move_to(pair, scale, sample, state);
    meet_forces(pair, sample, friction, state);
    (*state).step = sample * cell.steps.substeps;
    if (*state).step >= cell.steps.steps {
        (*state).status = FINISHED;
    }
}
