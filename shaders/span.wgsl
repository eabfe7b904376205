// The end of a span before any root search: that of a step, the limit of stability, or an impact to
// come. Twin: src/stepping/span.rs.

// The longest span over the relaxation time u_y/(n |u'|) of z in (11): RK4 is stable up to 2.79.
const YIELD_LIMIT = 2.0;
// A span that is cut for an impact is longer by this share than the estimated time to the impact.
const BEYOND = 5.0e-4;

struct Span {
    length: real,
    cut: bool,
}

// Whether the next span may be a whole step, wherever the last one ended: the block rocks, and its segment
// does not end in that step. A block that stands comes back to the whole numbers of steps, at which shared
// motions know it.
fn is_whole_ahead(rocking: bool, forcing: Forcing) -> bool {
    return rocking && forcing.steps > forcing.done + 1.0;
}

// Begins a span of `rest`: a whole step, or what is left of one. It ends earlier where RK4 would not be
// stable for z, and where the block lands by an estimate from its rates.
fn begin_span(
    cell: Cell,
    corner: Corner,
    rocking: bool,
    y: Motion,
    k1: Rates,
    rest: real,
    step: real,
) -> Span {
    let zero: real = 0.0;
    let beyond: real = 1.0 + BEYOND;
    var span = Span(rest, false);
    if kinks {
        // z of (11) relaxes at the rate n |u'|/u_y, 1/s.
        let limit: real = YIELD_LIMIT;
        let settling = real(bouc_wen_n) * abs(y.du) * cell.inverse_yield * step;
        if settling * span.length > limit {
            span = Span(limit / settling, true);
        }
    }
    if rocking {
        // phi + d s + a s^2/2 after the fraction s of a step.
        let phi = corner.side * y.phi;
        let d = corner.side * y.dphi * step;
        let a = corner.side * k1.ddphi * step * step;
        if phi + span.length * (d + 0.5 * a * span.length) < 0.0 {
            let root = sqrt(max(d * d - 2.0 * a * phi, zero));
            let falls = d < 0.0;
            let at = select(-(d + root), 2.0 * phi, falls) / select(a, root - d, falls) * beyond;
            if at > 0.0 && span.length > at {
                span = Span(at, true);
            }
        }
    }
    return span;
}
