//! The fit to multiple stripes.

use super::binary::{self, Binary, Line};
use super::curve::Lognormal;
use super::fit::Fit;
use super::link::probit;
use super::runs::Stripe;

/// The lognormal curve of largest likelihood: the maximum of the sum over levels x_j of
/// ln Binom(z_j; n_j, Phi(ln(x_j/theta)/beta)) with beta > 0 (Baker 2015, Earthquake Spectra 31(1), 579-599). It is a
/// probit regression on ln x with the intercept -ln(theta)/beta and the slope 1/beta. A level may have one run, so that
/// each record may be at levels of its own, and counts may be weighted.
pub fn fit(stripes: &[Stripe]) -> Fit {
    fit_near(stripes, None)
}

/// The same from a curve that is near, such as that of the set that a resampled one comes from.
pub(super) fn fit_near(stripes: &[Stripe], near: Option<Lognormal>) -> Fit {
    let near = near.map(|curve| Line { at: curve.theta.ln(), scale: curve.beta });
    match binary::fit(stripes, probit, near) {
        Binary::Line(line) => Fit::of_logarithm(line.at, line.scale),
        Binary::Separable(gap) => Fit::Separable(gap),
        Binary::NotIncreasing => Fit::NotIncreasing,
        Binary::NoRuns => Fit::NoRuns,
    }
}
