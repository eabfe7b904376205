//! Integrals over one segment of a hazard curve, a power law between two points.

use super::fit::Lognormal;
use crate::statistics::normal;

/// Nodes and weights of Gauss and Legendre for four points on -1 to 1.
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_86],
    [-0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_86],
];
/// Beyond this many beta above ln theta the probability is one to rounding; below, what is left of its product with the
/// hazard is nothing to rounding.
pub(super) const REACH: f64 = 8.5;

/// The integral between two points.
pub(super) fn segment(from: [f64; 2], to: [f64; 2], fragility: &Lognormal) -> f64 {
    let k = (from[1] - to[1]) / (to[0] - from[0]);
    let lambda = |y: f64| (from[1] - k * (y - from[0])).exp();
    let middle = fragility.theta.ln();
    let reach = REACH * fragility.beta;
    // Downwards lambda grows by exp(k y), which moves the middle of the product down by k beta^2.
    let low = (middle - reach - k * fragility.beta.powi(2)).clamp(from[0], to[0]);
    let high = (middle + reach).clamp(from[0], to[0]);
    // Above, all fail.
    let above = lambda(high) - to[1].exp();
    if !(high > low && k > 0.0) {
        return above.max(0.0);
    }
    let at = |y: f64| [y, from[1] - k * (y - from[0])];
    let probability = |y: f64| normal::cdf((y - middle) / fragility.beta);
    let changing = integral(at(low), at(high), fragility.beta, &probability);
    changing + above.max(0.0)
}

/// The integral of P(y) |d lambda(y)| between two points of a power law, in pieces no longer than half of `beta` and of 1/k.
pub(super) fn integral(
    from: [f64; 2],
    to: [f64; 2],
    beta: f64,
    probability: &dyn Fn(f64) -> f64,
) -> f64 {
    let k = (from[1] - to[1]) / (to[0] - from[0]);
    if !(k > 0.0) {
        return 0.0;
    }
    let pieces = ((to[0] - from[0]) / (0.5 * beta.min(1.0 / k))).ceil().max(1.0);
    let half = 0.5 * (to[0] - from[0]) / pieces;
    let mut sum = 0.0;
    for piece in 0..pieces as u32 {
        let centre = from[0] + half * f64::from(2 * piece + 1);
        for [node, weight] in GAUSS {
            let y = centre + half * node;
            sum += half * weight * probability(y) * k * (from[1] - k * (y - from[0])).exp();
        }
    }
    sum
}
