//! What a fit answers: a curve, or why there is none.

use super::curve::{Curve, Lognormal};

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
