//! A hazard curve, and the annual rate of failure over it.

use super::curve::{Curve, Part, Shape};
use super::hazard_segment::segment;
use crate::sheet::TableError;
use crate::statistics::normal;
use topple::scene::record::rounded;

/// Largest file of a hazard curve that is read, bytes.
pub const LARGEST: u64 = 16 << 20;

/// Annual rates at which levels of the intensity measure are exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// ln of the level and ln of the rate, by ascending level.
    pub(super) points: Vec<[f64; 2]>,
}

/// The annual rate of failure over a hazard curve, and what the ends of the curve leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnualRate {
    /// The rate of failures by motions between the first and the last level of the curve, 1/year.
    pub rate: f64,
    /// Motions above the last level add no more than this, the rate of the last level. At least the probability of failing
    /// there times this rate is missing.
    pub missing_above: f64,
    /// Motions below the first level add no more than this, 1/year, where the curve is nowhere steeper there than between
    /// its first two levels: see [`HazardCurve::rate`]. Infinite where this is beyond what numbers hold.
    pub missing_below: f64,
}

impl AnnualRate {
    /// The rate with all that may be missing at both ends of the curve, 1/year.
    pub fn at_most(&self) -> f64 {
        self.rate + self.missing_above + self.missing_below
    }
}

/// The probability that something of an annual rate happens in 50 years, 1 - exp(-50 rate).
pub fn in_50_years(rate: f64) -> f64 {
    -(-50.0 * rate).exp_m1()
}

impl HazardCurve {
    /// Of points, a level and its rate each, with the lines that they are in: ascending levels, rates that do not rise.
    pub fn of(table: &[(usize, [f64; 2])]) -> Result<HazardCurve, TableError> {
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(table.len());
        for (line, point) in table {
            let (line, point) = (*line, point.map(f64::ln));
            match points.last() {
                Some(before) if point[0] <= before[0] => {
                    let problem =
                        "the level is not above that of the line before; sort the lines by level";
                    return Err(TableError::at(line, problem));
                }
                Some(before) if point[1] > before[1] => {
                    let problem = "the rate is above that of a lower level; give the rates at which levels are exceeded";
                    return Err(TableError::at(line, problem));
                }
                _ => points.push(point),
            }
        }
        if points.len() < 2 {
            let count = points.len();
            return Err(TableError::whole(format!(
                "the curve has {count} points; give two at least"
            )));
        }
        Ok(HazardCurve { points })
    }

    /// The largest rate of the curve, 1/year.
    pub(super) fn most(&self) -> f64 {
        self.points.first().map_or(0.0, |point| point[1].exp())
    }

    /// The annual rate of failure, the integral of P(fail | x) |d lambda(x)| over the curve.
    ///
    /// Between its points the curve is a power of x, linear in ln x and ln lambda, as is usual. It is not extended beyond
    /// its ends. The sum over trapezoids in ln x of P |d lambda|, whose value depends on how far apart the points are,
    /// goes to this integral as points are put between them.
    ///
    /// Where a part of P changes, eight points of Gauss and Legendre serve each piece of ln x, no longer than h, the smaller of the scale
    /// of the part and 1/k, where k is the slope of ln lambda. Above P is 1 to 1e-17, below it is less than 1e-60 and left out.
    /// The integrand is analytic in an ellipse about a piece with the half axes 2.1 h and 2 h, the poles of a logistic curve being pi h away
    /// or more; there it is at most 13 times what it is within two h of the piece. The rule's error is then below 64/15 times 8.1^-16
    /// times this: 1e-13 of the largest value of the integrand about the piece, whose integral is the rate.
    ///
    /// What is missing below the first level x_1 has no bound without an assumption: the curve does not tell how many
    /// motions there are. The assumption is that lambda(x) <= lambda_1 (x/x_1)^-k there, with the slope k between the first two
    /// levels: hazard curves bend downwards in logarithms. P rises from zero, so that by parts the integral of P |d lambda| is
    /// that of lambda dP less lambda_1 P(x_1), and is largest where lambda is.
    pub fn rate(&self, curve: impl Into<Curve>) -> AnnualRate {
        let curve = curve.into();
        let [ends @ .., last] = self.points.as_slice() else {
            return AnnualRate { rate: 0.0, missing_above: 0.0, missing_below: 0.0 };
        };
        let segments = ends.iter().zip(&self.points[1..]);
        AnnualRate {
            rate: segments.map(|(from, to)| segment(*from, *to, &curve)).sum(),
            missing_above: last[1].exp(),
            missing_below: below(self.points[0], self.points[1], &curve),
        }
    }

    /// True where its first level is not above a level.
    pub fn begins_below(&self, level: f64) -> bool {
        self.points[0][0] <= level.ln()
    }

    /// Its points by ascending level: the level and its annual rate.
    pub fn points(&self) -> Vec<[f64; 2]> {
        // Twelve digits: of a number that went through its logarithm the last ones are noise.
        self.points.iter().map(|point| point.map(|value| rounded(value.exp(), 12))).collect()
    }

    /// The levels of its ends.
    pub fn ends(&self) -> [f64; 2] {
        [self.points[0], self.points[self.points.len() - 1]].map(|point| point[0].exp())
    }
}

/// The integral of P(x) |d lambda(x)| below a point, the slope of the curve that between the point and the next. Of one normal part it has
/// a closed form; of others, from where each part has less than 1e-17 on, the sum of those of the parts.
fn below(first: [f64; 2], next: [f64; 2], curve: &Curve) -> f64 {
    let k = (first[1] - next[1]) / (next[0] - first[0]);
    let far = match curve.only() {
        Some(Part { shape: Shape::Normal, .. }) => first[0],
        _ => curve.parts().map(|part| part.begins()).fold(first[0], f64::min),
    };
    let from = [far, first[1] + k * (first[0] - far)];
    let tails: f64 = curve.parts().map(|part| tail(from, k, &part)).sum();
    let between = if far < first[0] { segment(from, first, curve) } else { 0.0 };
    let all = between + tails;
    if all.is_nan() { f64::INFINITY } else { all.max(0.0) }
}

/// The same of a part, below a point of the power lambda_1 (x/x_1)^-k. Of a normal one it is lambda_1 [exp(k beta u + k^2 beta^2/2)
/// Phi(u + k beta) - Phi(u)], u = ln(x_1/theta)/beta; of a logistic one far below its middle, where it is exp(u), lambda_1 exp(u)
/// k beta/(1 - k beta), without a bound from k beta = 1 on.
fn tail(first: [f64; 2], k: f64, part: &Part) -> f64 {
    let (above, beta) = (first[0] - part.at, part.scale);
    if !(beta > 0.0) {
        return if above > 0.0 { (first[1] + k * above).exp() - first[1].exp() } else { 0.0 };
    }
    let (u, grown) = (above / beta, k * beta);
    match part.shape {
        Shape::Normal => {
            let all = k * above + 0.5 * grown * grown + normal::ln_cdf(u + grown);
            (first[1] + all).exp() - (first[1] + normal::ln_cdf(u)).exp()
        }
        Shape::Logistic if grown < 1.0 => (first[1] + u).exp() * grown / (1.0 - grown),
        Shape::Logistic => f64::INFINITY,
    }
}
