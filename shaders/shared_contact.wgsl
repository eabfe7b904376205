// The full contact that cells share: where it takes a cell before the cell lifts.
// Twin: src/sweep/shared_contact.rs.

// The shared motions. Twin: src/sweep/motions.rs.
@group(0) @binding(12) var<storage, read> motions: array<real>;

const DISPLACEMENT = 0u;
const VELOCITY = 1u;
const ACCELERATION = 2u;
const LEAST = 3u;
const TOP = 4u;
const LOWEST = 5u;
const HYSTERETIC = 5u;
const MOST = 6u;
const HIGHEST = 7u;
const DEEPEST = 8u;
const STRONGEST = 9u;
const TROUGH = 6u;
const CREST = 10u;
const EIGHTHS_V = 7u;
const QUARTERS_H = 11u;
const BOTTOM = 14u;
const LIGHTEST = 15u;

// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
// (14) is between two bounds, and Y above one.
fn lifts(lever: real, most: real, least: real, least_y: real) -> bool {
    // A negative lever turns the bounds about.
    let one = lever * most;
    let other = lever * least;
    return max(one, other) > model.left.arm * least_y
        || max(-one, -other) > model.right.arm * least_y;
}

// The first gap in which a cell may lift by the largest bounds of X and the least of Y so far, which do not
// fall and do not rise from gap to gap; or the last sample, which ends no gap. It lifts in no gap before.
fn first_beyond(h: u32, v: u32, last: u32, last_v: u32, lever: real) -> u32 {
    let highest = h + HIGHEST * tile.across.more;
    let deepest = h + DEEPEST * tile.across.more;
    let lightest = v + LIGHTEST * tile.up.more;
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
        let least_y = motions[lightest + min(gap, max(last_v, 1u) - 1u)];
        if size * motions[highest + gap] > rising * least_y
            || size * motions[deepest + gap] > falling * least_y {
            high = gap;
        } else {
            low = gap + 1u;
        }
    }
    return low;
}

// The first gap in which a cell may lift, from a gap on, or the last sample.
fn first_lift(h: u32, v: u32, last: u32, last_v: u32, lever: real, first: u32) -> u32 {
    let most = h + MOST * tile.across.more;
    let least = h + LEAST * tile.across.more;
    let least_y = v + LEAST * tile.up.more;
    var sample = first;
    while sample < last {
        let y = motions[least_y + min(sample, max(last_v, 1u) - 1u)];
        if lifts(lever, motions[most + sample], motions[least + sample], y) {
            break;
        }
        sample += 1u;
    }
    return sample;
}

// The friction asked for at the samples before one. A motion grows until the block lifts: from the last
// sample backwards, until the largest |X| so far over the least Y so far exceeds no more.
fn at_samples(h: u32, v: u32, last_v: u32, size: real, sample: u32) -> real {
    let x = h + ACCELERATION * tile.across.more;
    let y = v + ACCELERATION * tile.up.more;
    let strongest = h + STRONGEST * tile.across.more;
    let lowest = v + LOWEST * tile.up.more;
    var friction: real = 0.0;
    for (var before = sample; before > 0u; before--) {
        let limit = size * motions[strongest + before - 1u];
        if friction * motions[lowest + min(before, last_v)] >= limit {
            break;
        }
        let gap = before - 1u;
        let share = share(abs(motions[x + gap]), motions[y + min(gap, max(last_v, 1u) - 1u)]);
        friction = max(friction, size * share);
    }
    return friction;
}

// Share of the friction asked for by which a gap must exceed it to be looked into.
const OVER = 2.0e-4;

struct Dip {
    least: real,
    at: real,
}

// The least of the parabola through three values evenly apart, and at what fraction of the way.
fn dip(start: real, mid: real, end: real) -> Dip {
    let zero: real = 0.0;
    let one: real = 1.0;
    let slope = end_slopes(start, mid, end);
    var at = select(zero, one, end < start);
    if slope.rise < 0.0 && slope.fall > 0.0 {
        at = slope.rise / (slope.rise - slope.fall);
    }
    return Dip(parabola(start, mid, end, at), at);
}

// The friction asked for up to a sample, crests between samples included: in gaps where the largest |X|
// over the least Y exceeds the largest so far, it is looked for on parabolas through eighths of them, and
// where Y is least. How small Y is there is known; the parabolas tell when. Backwards as at the samples.
fn crests(h: u32, v: u32, last_v: u32, size: real, sample: u32, friction_before: real) -> real {
    let zero: real = 0.0;
    let early: real = 0.25;
    let late: real = 0.75;
    let over: real = 1.0 + OVER;
    let all_h = tile.across.more;
    let all_v = tile.up.more;
    var friction = friction_before;
    for (var before = sample; before > 0u; before--) {
        let gap = before - 1u;
        let at = h + gap;
        let at_v = v + min(gap, max(last_v, 1u) - 1u);
        let most_x = motions[at + CREST * all_h];
        let trough = motions[at_v + TROUGH * all_v];
        let lowest = motions[v + min(before, last_v) + LOWEST * all_v];
        if over * friction * lowest >= size * motions[at + STRONGEST * all_h] {
            break;
        }
        if !(size * most_x > over * friction * trough) {
            continue;
        }
        let next = at + 1u + ACCELERATION * all_h;
        let next_v = at_v + 1u + ACCELERATION * all_v;
        let quarter = at + QUARTERS_H * all_h;
        let eighth = at_v + EIGHTHS_V * all_v;
        // Of spans of two eighths each: the largest share, and |X| where Y is least.
        var ends = zero;
        var top = zero;
        var least = motions[next_v - 1u];
        var x_there = motions[next - 1u];
        var x0 = x_there;
        var y0 = least;
        for (var span = 0u; span < 4u; span++) {
            // The parabola of X through the half of the gap that the span is in.
            let middle = motions[quarter + all_h];
            let first_half = span < 2u;
            let start_h = select(middle, motions[next - 1u], first_half);
            let mid_h = motions[quarter + select(2u, 0u, first_half) * all_h];
            let end_h = select(motions[next], middle, first_half);
            let at_h = select(late, early, span % 2u == 0u);
            let x1 = parabola(start_h, mid_h, end_h, at_h);
            let x2 = select(end_h, mid_h, span % 2u == 0u);
            let y1 = motions[eighth + 2u * span * all_v];
            var y2 = motions[next_v];
            if span < 3u {
                y2 = motions[eighth + (2u * span + 1u) * all_v];
            }
            let start = size * share(abs(x0), y0);
            let mid = size * share(abs(x1), y1);
            let end = size * share(abs(x2), y2);
            ends = max(ends, max(max(start, mid), end));
            top = max(top, crest(start, mid, end));
            let lower = dip(y0, y1, y2);
            if lower.least < least {
                least = lower.least;
                x_there = parabola(x0, x1, x2, lower.at);
            }
            x0 = x2;
            y0 = y2;
        }
        var most = ends;
        if trough > 0.0 {
            // No more than the bound that the gap was looked into for.
            let bound = size * share(most_x, trough);
            let there = size * share(abs(x_there), trough);
            most = min(max(max(top, there), ends), max(bound, ends));
        }
        friction = max(friction, most);
    }
    return friction;
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
            friction = size * motions[h + STRONGEST * all_h + sample - 1u] / y;
        }
    } else if forces {
        friction = at_samples(h, v, last_v, size, sample);
        friction = crests(h, v, last_v, size, sample, friction);
    }
    let at = min(sample, last_v);
    var z = motions[h + HYSTERETIC * all_h + sample];
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
    let lowest = motions[v + LOWEST * all_v + at];
    if lowest < (*state).min_contact {
        (*state).min_contact = lowest;
    }
    (*state).friction = friction;
    (*state).step = min(sample * cell.substeps, cell.steps_forced);
    if (*state).step >= cell.steps {
        (*state).status = FINISHED;
    }
}
