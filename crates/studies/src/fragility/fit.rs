//! What a fit answers: a curve, or why there is none.

use super::curve::Curve;

/// A lognormal fragility: P(x) = Phi(ln(x/theta)/beta).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lognormal {
    /// The median: the level at which half of the records fail.
    pub theta: f64,
    /// The standard deviation of the logarithm of the level. Zero makes a step at theta.
    pub beta: f64,
}

impl Lognormal {
    /// From the logarithm of theta; `None` where theta or beta is beyond what numbers hold.
    pub(super) fn of_logarithm(ln_theta: f64, beta: f64) -> Option<Lognormal> {
        let theta = ln_theta.exp();
        (is_level(theta) && beta >= 0.0 && beta.is_finite()).then_some(Lognormal { theta, beta })
    }

    /// The probability that the limit state fails at a level.
    pub fn probability(&self, level: f64) -> f64 {
        Curve::from(self).probability(level)
    }
}

/// Whether a number can be a level. A subnormal number has lost digits: a median there would answer for another.
pub(super) fn is_level(number: f64) -> bool {
    number > 0.0 && number.is_normal()
}

/// Between which levels standing turns into failing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The highest level at which a run stands; none where no run stands.
    pub stands: Option<f64>,
    /// The lowest level at which a run fails; none where no run fails. It is not below `stands`. Both are equal where
    /// runs stand and fail at one level, and at no other level both happen.
    pub fails: Option<f64>,
}

impl Gap {
    /// The geometric middle; none where an end is open.
    pub fn middle(&self) -> Option<f64> {
        Some((0.5 * (self.stands?.ln() + self.fails?.ln())).exp())
    }
}

/// What an estimator answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fit {
    /// The curve.
    Fitted(Curve),
    /// No run fails below a level, and none stands above it: the likelihood has no maximum with beta > 0, it grows while
    /// beta goes to zero. Where an end of the gap is open, all runs fail or none does.
    Separable(Gap),
    /// Failures do not become more likely with the level, or by so little that theta is beyond what numbers hold.
    NotIncreasing,
    /// Fewer than two motions fail: their capacities have no deviation.
    TooFewFailed,
    /// Fewer than three runs that stand have a demand above zero, or all of them are at one level.
    TooFewDemands,
    /// There is no run.
    NoRuns,
}

impl Fit {
    /// The curve, if there is one.
    pub fn curve(&self) -> Option<Curve> {
        match self {
            Fit::Fitted(curve) => Some(*curve),
            _ => None,
        }
    }

    /// Of a position and a scale on the axis of ln x.
    pub(super) fn of_logarithm(ln_theta: f64, beta: f64) -> Fit {
        let curve = Lognormal::of_logarithm(ln_theta, beta);
        curve.map_or(Fit::NotIncreasing, |curve| Fit::Fitted(curve.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_that_has_lost_digits_is_no_curve() {
        for ln_theta in [700.0, -700.0] {
            let curve = Lognormal::of_logarithm(ln_theta, 1.0).expect("a normal number");
            assert!((curve.theta.ln() - ln_theta).abs() < 1.0e-12 * 700.0);
        }
        // exp(-741.9) = 4e-323 has one digit, exp(-746) none, and exp(710) is infinite.
        for ln_theta in [-709.0, -741.9, -746.0, 710.0, f64::NAN] {
            assert_eq!(Lognormal::of_logarithm(ln_theta, 1.0), None, "{ln_theta}");
        }
    }
}
