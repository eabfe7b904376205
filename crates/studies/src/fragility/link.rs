//! Probit and logit: from a number on the line to a probability, as logarithms with their derivatives.

use crate::statistics::normal;

/// The logarithm of a probability as a function of u, which is concave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogProbability {
    /// ln P.
    pub value: f64,
    /// d ln P/du.
    pub slope: f64,
    /// -d^2 ln P/du^2, not negative.
    pub curvature: f64,
}

/// That of failing and that of standing under the probit link, P = Phi(u).
pub fn probit(u: f64) -> [LogProbability; 2] {
    let [below, above] = normal::below_and_above(u);
    // The curvature of ln Phi is between 0 and 1; far in the tail rounding would leave that range.
    let bent = |ratio: f64, u: f64| (ratio * (ratio + u)).clamp(0.0, 1.0);
    [
        LogProbability { value: below.ln, slope: below.ratio, curvature: bent(below.ratio, u) },
        LogProbability { value: above.ln, slope: -above.ratio, curvature: bent(above.ratio, -u) },
    ]
}

/// The same under the logit link, P = 1/(1 + exp(-u)).
pub fn logit(u: f64) -> [LogProbability; 2] {
    let small = (-u.abs()).exp();
    let (smaller, larger) = (small / (1.0 + small), 1.0 / (1.0 + small));
    let (fails, stands) = if u < 0.0 { (smaller, larger) } else { (larger, smaller) };
    let bulk = small.ln_1p();
    let curvature = fails * stands;
    [
        LogProbability { value: u.min(0.0) - bulk, slope: stands, curvature },
        LogProbability { value: (-u).min(0.0) - bulk, slope: -fails, curvature },
    ]
}
