// The end of a span before any search for a root: the end of the step, the limit of stability, or an estimated
// impact. Twin: src/stepping/span.rs.

// The longest span over the relaxation time u_y/(n |u'|) of z in (11): RK4 is stable up to 2.79.
const YIELD_LIMIT = 2.0;
// The longest span against an end stop, or on a spring that hardens, times the rate of the motion there.
const STIFF_LIMIT = 0.1;
// The share by which a span that is cut for an impact is longer than the estimated time to the impact.
const BEYOND = 5.0e-4;

struct Span {
    length: real,
    cut: bool,
}

// Begins a span with the rest of the step. It ends earlier where RK4 would be unstable for z, and where the block
// lands by an estimate from its rates.
fn begin_span(
    cell: Cell,
    corner: Corner,
    rocking: bool,
    y: Motion,
    k1: Rates,
    start: real,
    step: real,
) -> Span {
    let zero: real = 0.0;
    let beyond: real = 1.0 + BEYOND;
    var span = Span(1.0 - start, false);
    if stops || hardens {
        // The rate of the fastest motion: against the stop, or on the spring at its largest stiffness.
        var rate = cell.horizontal.stop_rate * abs(stop);
        if hardens {
            rate = max(rate, sqrt(cell.vertical.stiffness_v + 3.0 * cell.vertical.hardening_v * y.v * y.v));
        }
        let limit: real = STIFF_LIMIT;
        let turned = rate * step;
        if turned * span.length > limit {
            span = Span(limit / turned, true);
        }
    }
    if kinks && yields {
        // z of (11) relaxes at the rate n |u'|/u_y, 1/s.
        let limit: real = YIELD_LIMIT;
        let settling = real(bouc_wen_n) * abs(y.du) * cell.horizontal.inverse_yield * step;
        if settling * span.length > limit {
            span = Span(limit / settling, true);
        }
    }
    if rocking {
        // The angle is phi + d s + a s^2/2 after the fraction s of a step.
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
