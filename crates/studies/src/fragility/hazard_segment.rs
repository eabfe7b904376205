//! Integrals over one segment of a hazard curve, a power law between two points.

use super::bisection::bisected;
use super::curve::{Curve, Part, fails};

/// Nodes above zero and weights of Gauss and Legendre for eight points on -1 to 1.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];
/// Halvings of a piece in which two curves meet.
const HALVINGS: u32 = 60;

/// The integral of a curve between two points: part by part where they change, what is counted where all fail.
pub(super) fn segment(from: [f64; 2], to: [f64; 2], curve: &Curve) -> f64 {
    let k = (from[1] - to[1]) / (to[0] - from[0]);
    if !(k > 0.0) {
        return 0.0;
    }
    let at = |y: f64| [y, from[1] - k * (y - from[0])];
    let mut breaks = [from[0], to[0], to[0], to[0], to[0], to[0]];
    for (place, end) in breaks[2..].iter_mut().zip(curve.parts().flat_map(|part| part.ends())) {
        *place = end.clamp(from[0], to[0]);
    }
    breaks.sort_by(f64::total_cmp);
    let between = |ends: &[f64]| {
        let (left, right) = (at(ends[0]), at(ends[1]));
        let middle = 0.5 * (left[0] + right[0]);
        if !(right[0] > left[0]) {
            return 0.0;
        }
        if curve.parts().any(|part| middle > part.ends()[1]) {
            return left[1].exp() - right[1].exp();
        }
        let changing = curve.parts().filter(|part| middle > part.ends()[0]);
        match scale(changing.clone()) {
            Some(scale) => {
                integral(left, right, scale, &|_| false, &|y| fails(changing.clone(), y))
            }
            None => 0.0,
        }
    };
    breaks.windows(2).map(between).sum()
}

/// The least scale of some parts.
pub(super) fn scale(parts: impl Iterator<Item = Part>) -> Option<f64> {
    parts.map(|part| part.scale).reduce(f64::min)
}

/// The integral of P(y) |d lambda(y)| between two points of a power law, in pieces no longer than `scale` and 1/k. Where `above` differs
/// at the ends of a piece P has a kink, and the piece is cut there.
pub(super) fn integral(
    from: [f64; 2],
    to: [f64; 2],
    scale: f64,
    above: &dyn Fn(f64) -> bool,
    probability: &dyn Fn(f64) -> f64,
) -> f64 {
    let k = (from[1] - to[1]) / (to[0] - from[0]);
    if !(k > 0.0) {
        return 0.0;
    }
    let smooth = |low: f64, high: f64| {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let at = |y: f64| probability(y) * k * (from[1] - k * (y - from[0])).exp();
        let node = |[node, weight]: &[f64; 2]| {
            half * weight * (at(centre - half * node) + at(centre + half * node))
        };
        GAUSS.iter().map(node).sum::<f64>()
    };
    let range = to[0] - from[0];
    let pieces = (range / scale.min(1.0 / k)).ceil().max(1.0);
    let piece = |number: u32| {
        let end = |number: u32| from[0] + range * (f64::from(number) / pieces);
        let (low, high) = (end(number), end(number + 1));
        let side = above(low);
        if above(high) == side {
            return smooth(low, high);
        }
        let [kink, _] = bisected([low, high], HALVINGS, |middle| above(middle) == side);
        smooth(low, kink) + smooth(kink, high)
    };
    (0..pieces as u32).map(piece).sum()
}
