// The friction demand of full contact, from the motions that cells share. Twin: src/cells/contact/shared_friction.rs.

// The friction demand at the samples before a given one, if it is known at some. The motion of a block grows until
// the block lifts, so the search goes backwards from the last sample, until the largest |X| so far over the least Y
// so far is not larger any more.
fn at_samples(h: u32, v: u32, last_v: u32, size: real, sample: u32, known: real) -> real {
    let x = h + ACCELERATION * tile.across.more;
    let y = v + ACCELERATION * tile.up.more;
    let magnitude_so_far = h + MAGNITUDE_SO_FAR * tile.across.more;
    let least_so_far = v + LEAST_SO_FAR * tile.up.more;
    var friction = known;
    for (var before = sample; before > 0u; before--) {
        let limit = size * motions[magnitude_so_far + before - 1u];
        if friction * motions[least_so_far + min(before, last_v)] >= limit {
            break;
        }
        let gap = before - 1u;
        let share = share(abs(motions[x + gap]), motions[y + gap_of_v(gap, last_v)]);
        friction = max(friction, size * share);
    }
    return friction;
}

// The share of the friction demand by which a gap must exceed it to be searched.
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

// The friction demand up to a sample, crests between samples included. Where the largest |X| of a gap over its least
// Y exceeds the largest demand so far, the demand is searched for on parabolas through eighths of the gap and at the
// least Y, backwards as at the samples. The least Y is known; the parabolas tell its time.
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
        let at_v = v + gap_of_v(gap, last_v);
        let magnitude = motions[at + MAGNITUDE * all_h];
        let least_y = motions[at_v + LEAST * all_v];
        let least_so_far = motions[v + min(before, last_v) + LEAST_SO_FAR * all_v];
        if over * friction * least_so_far >= size * motions[at + MAGNITUDE_SO_FAR * all_h] {
            break;
        }
        if !(size * magnitude > over * friction * least_y) {
            continue;
        }
        let next = at + 1u + ACCELERATION * all_h;
        let next_v = at_v + 1u + ACCELERATION * all_v;
        let quarter = at + QUARTERS_H * all_h;
        let eighth = at_v + EIGHTHS_V * all_v;
        // Of spans of two eighths each: the largest share, and |X| at the least Y.
        var ends = zero;
        var top = zero;
        var least = motions[next_v - 1u];
        var x_there = motions[next - 1u];
        var x0 = x_there;
        var y0 = least;
        for (var span = 0u; span < 4u; span++) {
            // The parabola of X through that half of the gap in which the span lies.
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
        if least_y > 0.0 {
            // The result is not above the bound because of which the gap was searched.
            let bound = size * share(magnitude, least_y);
            let there = size * share(abs(x_there), least_y);
            most = min(max(max(top, there), ends), max(bound, ends));
        }
        friction = max(friction, most);
    }
    return friction;
}
