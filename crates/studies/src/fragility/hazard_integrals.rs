//! Integrals over parts of a hazard curve: of a fragility, of shares, of curves that are held below others.

use super::curve::{Curve, Part};
use super::hazard::HazardCurve;
use super::hazard_segment::{integral, scale, segment};

impl HazardCurve {
    /// The rate of failure of the levels between two logarithms alone, as [`HazardCurve::rate`] of all.
    pub fn rate_between(&self, curve: impl Into<Curve>, low: f64, high: f64) -> f64 {
        let curve = curve.into();
        // Of no segment the sum is -0.
        self.segments(low, high).map(|(from, to)| segment(from, to, &curve)).sum::<f64>() + 0.0
    }

    /// The rate of a probability that is given at points, ln x and P each, and linear in ln x between them; zero below the
    /// first, constant above the last. Of P = p + s (y - y_0) and lambda = lambda_0 exp(-k (y - y_0)) the integral of P |d lambda| is,
    /// by parts, P_0 lambda_0 - P_1 lambda_1 + s (lambda_0 - lambda_1)/k.
    pub fn rate_of_shares(&self, shares: &[[f64; 2]]) -> f64 {
        let Some(last) = shares.last() else { return 0.0 };
        let after = [[*last, [f64::INFINITY, last[1]]]];
        let pairs = shares.windows(2).map(|pair| [pair[0], pair[1]]).chain(after);
        let piece = |[from, to]: [[f64; 2]; 2]| {
            let slope = (to[1] - from[1]) / (to[0] - from[0]);
            let share = |y: f64| from[1] + slope * (y - from[0]);
            let of = |(left, right): ([f64; 2], [f64; 2])| {
                let [before, after] = [left, right].map(|point| point[1].exp());
                let (k, apart) = (left[1] - right[1], right[0] - left[0]);
                // The mean of lambda over the segment; where it is flat, lambda itself.
                let mean = if k > 0.0 { before * -(-k).exp_m1() / k } else { before };
                share(left[0]) * before - share(right[0]) * after + slope * mean * apart
            };
            self.segments(from[0], to[0]).map(of).sum::<f64>()
        };
        pairs.map(piece).sum::<f64>().max(0.0)
    }

    /// The part of a curve's rate that comes from above the lowest of others: the integral of the difference where it is positive.
    pub fn excess(&self, curve: &Curve, others: &[Curve]) -> f64 {
        self.with_others(curve, others, |own, lowest| (own - lowest).max(0.0))
    }

    /// The rate of a curve that is held below others.
    pub fn held_below(&self, curve: &Curve, others: &[Curve]) -> f64 {
        self.with_others(curve, others, f64::min)
    }

    /// The integral of what a curve's probability and the lowest of others make together; it does not change with the level
    /// where none of them does.
    fn with_others(
        &self,
        curve: &Curve,
        others: &[Curve],
        together: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let parts: Vec<Part> = others.iter().chain([curve]).flat_map(Curve::parts).collect();
        // Where a part begins and ends to change; the ends of the hazard.
        let mut breaks = vec![f64::MIN, f64::MAX];
        breaks.extend(parts.iter().flat_map(Part::ends));
        breaks.sort_by(f64::total_cmp);
        let lowest = |y: f64| others.iter().map(|other| other.at(y)).fold(1.0, f64::min);
        let probability = |y: f64| together(curve.at(y), lowest(y));
        let above = |y: f64| curve.at(y) > lowest(y);
        let between = |ends: &[f64]| {
            let middle = 0.5 * ends[0] + 0.5 * ends[1];
            let changes = |part: &Part| {
                let [low, high] = part.ends();
                low < middle && middle < high
            };
            let scale = scale(parts.iter().copied().filter(changes)).unwrap_or(f64::MAX);
            let of = |(from, to)| integral(from, to, scale, &above, &probability);
            self.segments(ends[0], ends[1]).map(of).sum::<f64>()
        };
        breaks.windows(2).map(between).sum::<f64>() + 0.0
    }

    /// Its segments between two logarithms of levels.
    fn segments(&self, low: f64, high: f64) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let clipped = move |ends: &[[f64; 2]]| {
            let (from, to) = (ends[0], ends[1]);
            let at = |y: f64| {
                let share = (y - from[0]) / (to[0] - from[0]);
                [y, from[1] + share * (to[1] - from[1])]
            };
            let left = if low > from[0] { at(low) } else { from };
            let right = if high < to[0] { at(high) } else { to };
            (left[0] < right[0]).then_some((left, right))
        };
        self.points.windows(2).filter_map(clipped)
    }
}
