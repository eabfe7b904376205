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
    pub(super) fn of(table: &[(usize, [f64; 2])]) -> Result<HazardCurve, TableError> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::Lognormal;
    use crate::fragility::hazard_text;
    use crate::suites::intensity::Intensity;

    fn table(text: &str) -> HazardCurve {
        hazard_text::read(text, Intensity::Pga, None).unwrap().curve
    }

    fn curve(rate: impl Fn(f64) -> f64, from: f64, to: f64, count: u32) -> HazardCurve {
        let point = |k: u32| {
            let y = from.ln() + (to / from).ln() * f64::from(k) / f64::from(count - 1);
            [y, rate(y.exp()).ln()]
        };
        HazardCurve { points: (0..count).map(point).collect() }
    }

    #[test]
    fn a_power_law_has_its_closed_form() {
        // lambda = k_0 x^-k: the rate is k_0 theta^-k exp(k^2 beta^2/2) (Cornell 1996).
        for (k, theta, beta) in [(2.0, 1.0, 0.4), (3.5, 0.4, 0.2), (1.0, 2.0, 0.8), (2.5, 0.7, 1.5)]
        {
            let hazard = curve(|x| 1.0e-3 * x.powf(-k), 1.0e-6, 1.0e9, 31);
            let wanted = 1.0e-3 * f64::powf(theta, -k) * (0.5 * k * k * beta * beta).exp();
            let found = hazard.rate(Lognormal { theta, beta });
            assert!((found.rate / wanted - 1.0).abs() < 1.0e-7, "{} {wanted}", found.rate);
        }
    }

    #[test]
    fn trapezoids_go_to_the_rate_as_points_are_put_between() {
        let fragility = Lognormal { theta: 0.8, beta: 0.3 };
        let law = |x: f64| 0.01 * x.powf(-1.7);
        let wanted = curve(law, 0.1, 4.0, 6).rate(fragility).rate;
        let trapezoids = |count: u32| {
            let points = curve(law, 0.1, 4.0, count).points;
            let p = |point: &[f64; 2]| fragility.probability(point[0].exp());
            let gap = |ends: &[[f64; 2]]| {
                0.5 * (p(&ends[0]) + p(&ends[1])) * (ends[0][1].exp() - ends[1][1].exp())
            };
            points.windows(2).map(gap).sum::<f64>()
        };
        let errors = [50, 99, 197].map(|count| trapezoids(count) / wanted - 1.0);
        // A second-order rule: a quarter of the error with half of the distance.
        assert!(errors[0].abs() > 1.0e-4 && errors[2].abs() < 1.0e-3, "{errors:?}");
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{errors:?}");
        }
    }

    #[test]
    fn a_step_takes_the_rates_above_it() {
        let hazard = table("level,rate\n1,1e-2\n4,1e-4\n");
        let rate = |theta| hazard.rate(Lognormal { theta, beta: 0.0 });
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1.0e-12;
        // In the middle of ln x the rate is the geometric mean.
        assert!(near(rate(2.0).rate, 1.0e-3 - 1.0e-4), "{:?}", rate(2.0));
        assert!(near(rate(0.5).rate, 1.0e-2 - 1.0e-4) && rate(5.0).rate == 0.0);
        assert!(near(rate(2.0).missing_above, 1.0e-4) && rate(2.0).missing_below == 0.0);
        // Over four levels lambda falls to a hundredth, so that at half of the first level it is ten times as large.
        assert!(near(rate(0.5).missing_below, 1.0e-1 - 1.0e-2), "{:?}", rate(0.5));
        assert!(near(rate(0.5).at_most(), 1.0e-1), "{:?}", rate(0.5));
        let narrow = hazard.rate(Lognormal { theta: 2.0, beta: 1.0e-9 });
        assert!((narrow.rate / rate(2.0).rate - 1.0).abs() < 1.0e-7, "{narrow:?}");
    }

    /// The rate over the same power law from far below is found by quadrature, and what is missing by a closed form.
    #[test]
    fn what_is_missing_below_a_power_law_is_the_rate_of_its_part_below() {
        for (k, theta, beta) in [(2.0, 1.0, 0.4), (3.5, 0.4, 0.2), (1.0, 2.0, 0.8), (2.5, 0.7, 1.5)]
        {
            let law = |x: f64| 1.0e-3 * x.powf(-k);
            let fragility = Lognormal { theta, beta };
            let whole = curve(law, 1.0e-9, 30.0, 31).rate(fragility);
            for first in [0.01, 0.1, 0.7, 3.0, 20.0] {
                let cut = curve(law, first, 30.0, 5).rate(fragility);
                let found = cut.rate + cut.missing_below;
                assert!((found / whole.rate - 1.0).abs() < 2.0e-7, "{first}: {cut:?} {whole:?}");
                assert!(first < 0.5 * theta || cut.missing_below > 0.02 * whole.rate, "{cut:?}");
            }
        }
    }

    #[test]
    fn the_rate_of_a_whole_curve_is_within_the_bound_of_each_part_of_it() {
        let points =
            [(0.5, 0.05), (1.0, 0.02), (2.0, 6e-3), (4.0, 1.2e-3), (8.0, 1.5e-4), (16.0, 1e-5)];
        let of = |points: &[(f64, f64)]| {
            let rows: String = points.iter().map(|(x, rate)| format!("{x},{rate}\n")).collect();
            table(&format!("level,rate\n{rows}"))
        };
        for theta in [0.1, 0.7, 3.0, 12.9, 100.0] {
            for beta in [0.0, 0.02, 0.4, 0.8, 1.6] {
                let fragility = Lognormal { theta, beta };
                let whole = of(&points).rate(fragility).rate;
                for from in 0..points.len() - 1 {
                    let part = of(&points[from..]).rate(fragility);
                    assert!(whole <= part.at_most() * (1.0 + 1.0e-12), "{theta} {beta}: {part:?}");
                }
            }
        }
    }

    /// What is beyond the largest number is no bound, and below no target.
    #[test]
    fn a_curve_that_says_nothing_of_what_is_below_has_no_bound_there() {
        let steep = table("level,rate\n1.4,1e-1\n1.4000001,1e-9\n");
        let rate = steep.rate(Lognormal { theta: 1.4, beta: 0.4 });
        assert_eq!((rate.missing_below, rate.at_most()), (f64::INFINITY, f64::INFINITY));
        let flat = table("level,rate\n1,1e-3\n2,1e-3\n");
        assert_eq!(flat.rate(Lognormal { theta: 0.1, beta: 0.4 }).missing_below, 0.0);
    }

    #[test]
    fn flat_and_steep_curves_have_rates() {
        let flat = table("level,rate\n1,1e-3\n2,1e-3\n");
        let fragility = Lognormal { theta: 1.4, beta: 0.4 };
        assert_eq!(flat.rate(fragility).rate, 0.0);
        let steep = table("level,rate\n1.4,1e-1\n1.4000001,1e-9\n");
        assert!((steep.rate(fragility).rate / 0.05 - 1.0).abs() < 1.0e-5);
    }

    #[test]
    fn fifty_years() {
        assert!((in_50_years(1.0 / 475.0) - 0.099_9).abs() < 1.0e-4);
        assert_eq!(in_50_years(0.0), 0.0);
        assert!((in_50_years(1.0e-14) / 5.0e-13 - 1.0).abs() < 1.0e-12);
    }
}
