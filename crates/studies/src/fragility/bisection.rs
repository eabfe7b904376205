//! Where a condition ends, by halving.

/// The ends between which a condition ends, the first where it holds: of `[inner, outer]`, of which it holds at the first, halved so often.
pub(super) fn bisected(
    [mut inner, mut outer]: [f64; 2],
    halvings: u32,
    inside: impl Fn(f64) -> bool,
) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (inner + outer);
        if inside(middle) { inner = middle } else { outer = middle }
    }
    [inner, outer]
}
