// Where a span ends before anything is searched for. Twin: src/stepping/span.rs.

// The most that z of (11) may settle by in a span: RK4 is stable to 2.79.
const YIELD_LIMIT = 2.0;
// Share of itself by which a span is longer than the way to the impact that it is cut for.
const BEYOND = 5.0e-4;

struct Span {
    length: real,
    cut: bool,
}

// A span begins: what is left of the step, cut where z would settle by more than the method bears and
// where the block is about to land, as near as its rates tell.
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
    if kinks {
        // z of (11) settles at the rate n |u'|/u_y.
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
