//! Regression of standing and failing on the logarithm of the level, for any link.

use super::fit::Gap;
use super::link::LogProbability;
use super::newton::{self, Point};
use super::runs::Stripe;

/// A line u = (ln x - at)/scale; its link gives the probability of failing at x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// ln x where half of the runs fail.
    pub at: f64,
    /// How much ln x grows while u grows by one, above zero.
    pub scale: f64,
}

/// What the regression answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Binary {
    /// The line of largest likelihood.
    Line(Line),
    /// A step has the largest likelihood, or none of one kind exists.
    Separable(Gap),
    /// The maximum is at a slope of zero or less.
    NotIncreasing,
    /// No run.
    NoRuns,
}

/// The line of largest likelihood: the sum of z ln P + (n - z) ln(1 - P) over the stripes. It is concave in intercept
/// and slope under probit and logit, so that Newton's method finds it from any start; `near` is one that saves steps.
///
/// The maximum exists, and is one point, unless a level separates standing from failing (Silvapulle 1981, J. R. Stat.
/// Soc. B 43). Its slope is positive exactly where the likelihood grows with the slope at slope zero, which is where
/// the sum of (z - n p) ln x is positive, p the share of all runs that fails.
pub fn fit(
    stripes: &[Stripe],
    link: impl Fn(f64) -> [LogProbability; 2],
    near: Option<Line>,
) -> Binary {
    let runs: f64 = stripes.iter().map(|stripe| stripe.n).sum();
    let share = stripes.iter().map(|stripe| stripe.z).sum::<f64>() / runs;
    if !(runs > 0.0 && runs.is_finite()) {
        return Binary::NoRuns;
    }
    let gap = gap(stripes);
    match gap {
        Gap { stands: Some(stands), fails: Some(fails) } if stands > fails => (),
        // All runs at one level, of both kinds: no slope is better than another.
        _ => return Binary::Separable(gap),
    }
    // Centred, and scaled to a range of order one: levels far from one, or near together, then cost no digits.
    let logarithms: Vec<f64> = stripes.iter().map(|stripe| stripe.level.ln()).collect();
    let weighted = |of: &dyn Fn(usize) -> f64| {
        (0..stripes.len()).map(|j| stripes[j].n / runs * of(j)).sum::<f64>()
    };
    let centre = weighted(&|j| logarithms[j]);
    let spread = weighted(&|j| (logarithms[j] - centre).powi(2)).sqrt();
    if !(spread > 0.0) {
        return Binary::NotIncreasing;
    }
    let score = stripes
        .iter()
        .zip(&logarithms)
        .map(|(stripe, ln)| (stripe.z - stripe.n * share) / runs * (ln - centre) / spread);
    // Of a score that is zero, rounding leaves this much.
    if !(score.sum::<f64>() > 1.0e-13) {
        return Binary::NotIncreasing;
    }
    let counts: Vec<[f64; 3]> = stripes
        .iter()
        .zip(&logarithms)
        .map(|(stripe, ln)| [(ln - centre) / spread, stripe.z / runs, (stripe.n - stripe.z) / runs])
        .collect();
    let start = match near {
        Some(line) => [(centre - line.at) / line.scale, spread / line.scale],
        None => [0.6 * (share / (1.0 - share)).ln(), 0.0],
    };
    let found = newton::maximum(start, |[a, b]| likelihood(&counts, &link, a, b));
    match found {
        Some([a, b]) if b > 0.0 => {
            Binary::Line(Line { at: centre - spread * a / b, scale: spread / b })
        }
        // A start far off may end where the function is flat to rounding; the share of all runs is always safe.
        None if near.is_some() => fit(stripes, link, None),
        _ => Binary::NotIncreasing,
    }
}

/// The logarithm of the likelihood a run, with its derivatives by intercept and slope.
fn likelihood(
    counts: &[[f64; 3]],
    link: impl Fn(f64) -> [LogProbability; 2],
    a: f64,
    b: f64,
) -> Option<Point> {
    let (mut value, mut gradient, mut curvature) = (0.0, [0.0; 2], [0.0; 3]);
    for [s, fail, stand] in counts {
        let [fails, stands] = link(a + b * s);
        // A count of zero leaves out its logarithm, which may be infinite.
        let sum = |of: fn(&LogProbability) -> f64| {
            let fails = if *fail > 0.0 { fail * of(&fails) } else { 0.0 };
            fails + if *stand > 0.0 { stand * of(&stands) } else { 0.0 }
        };
        value += sum(|of| of.value);
        let (slope, bend) = (sum(|of| of.slope), sum(|of| of.curvature));
        gradient = [gradient[0] + slope, gradient[1] + slope * s];
        curvature = [curvature[0] + bend, curvature[1] + bend * s, curvature[2] + bend * s * s];
    }
    let finite = value.is_finite() && curvature[2].is_finite() && gradient[1].is_finite();
    finite.then_some(Point { value, gradient, curvature })
}

/// The highest level that stands and the lowest that fails.
pub(super) fn gap(stripes: &[Stripe]) -> Gap {
    let stands = stripes.iter().filter(|stripe| stripe.z < stripe.n).map(|stripe| stripe.level);
    let fails = stripes.iter().filter(|stripe| stripe.z > 0.0).map(|stripe| stripe.level);
    Gap { stands: stands.reduce(f64::max), fails: fails.reduce(f64::min) }
}
