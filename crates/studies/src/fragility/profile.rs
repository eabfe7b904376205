//! Intervals of separable data, by the profile likelihood.

use super::binary::gap;
use super::bisection::bisected;
use super::curve::is_level;
use super::fit::Gap;
use super::link::probit;
use super::newton::{self, Point};
use super::runs::Stripe;

/// Half of the 95 % point of chi-square with one degree of freedom.
const DROP: f64 = 1.920_729_410_347_062;
/// Halvings of a bracket: the bound is then known to 1e-7 of the range of the levels.
const HALVINGS: u32 = 24;

/// Bounds of theta and beta; none where there is no bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lower and upper bound of theta.
    pub theta: [Option<f64>; 2],
    /// Upper bound of beta. The lower one is zero.
    pub beta_high: Option<f64>,
}

impl Bounds {
    /// Where nothing is known.
    pub(super) const NONE: Bounds = Bounds { theta: [None; 2], beta_high: None };
}

/// The values of theta, and of beta, for which some value of the other brings the logarithm of the likelihood of the
/// stripes to within 1.92 of its supremum, which separable data reach as beta goes to zero: a 95 % interval by Wilks'
/// theorem, approximate here because beta = 0 is a border. The counts of a level are taken as independent of those
/// of others. Of stripes that are not separable it gives no bounds.
pub fn bounds(stripes: &[Stripe]) -> Bounds {
    let gap = gap(stripes);
    if matches!(gap, Gap { stands: Some(stands), fails: Some(fails) } if stands > fails) {
        return Bounds::NONE;
    }
    let ends = [gap.stands, gap.fails].map(|level| level.map(f64::ln));
    let mut logarithms = stripes.iter().map(|stripe| stripe.level.ln());
    let (Some(first), Some(last)) =
        (logarithms.clone().reduce(f64::min), logarithms.by_ref().reduce(f64::max))
    else {
        return Bounds::NONE;
    };
    let (centre, range) = (0.5 * (first + last), if last > first { last - first } else { 1.0 });
    let counts: Vec<[f64; 3]> = stripes
        .iter()
        .map(|stripe| [(stripe.level.ln() - centre) / range, stripe.z, stripe.n - stripe.z])
        .collect();
    let profile = Profile { counts, least: supremum(stripes, gap) - DROP };
    let level = |s: f64| Some((centre + range * s).exp()).filter(|x| is_level(*x));
    let [stands, fails] = ends.map(|end| end.map(|end| (end - centre) / range));
    Bounds {
        theta: [
            stands.and_then(|end| profile.theta(end, -1.0)).and_then(level),
            fails.and_then(|end| profile.theta(end, 1.0)).and_then(level),
        ],
        beta_high: stands
            .and(fails)
            .and_then(|_| profile.least_slope())
            .map(|slope| range / slope)
            .filter(|beta| beta.is_finite()),
    }
}

/// What the logarithm of the likelihood comes to as beta goes to zero: zero, and of a level at which runs stand and
/// fail that of its own share.
fn supremum(stripes: &[Stripe], gap: Gap) -> f64 {
    let mixed =
        stripes.iter().filter(|stripe| gap.stands == gap.fails && gap.fails == Some(stripe.level));
    mixed.map(|Stripe { n, z, .. }| z * (z / n).ln() + (n - z) * (1.0 - z / n).ln()).sum()
}

struct Profile {
    /// The level on the scaled axis, how many fail, how many stand.
    counts: Vec<[f64; 3]>,
    /// The least value that belongs to the interval.
    least: f64,
}

impl Profile {
    /// The bound of theta on the scaled axis, downwards (-1) or upwards (1) from an end of the gap.
    fn theta(&self, end: f64, side: f64) -> Option<f64> {
        let inside = |away: f64| self.over_slopes(end + side * away) >= self.least;
        let far = (-4..10).map(|k| 2.0_f64.powi(k)).find(|away| !inside(*away))?;
        Some(end + side * bisected([0.0, far], HALVINGS, inside)[0])
    }

    /// The least slope 1/beta on the scaled axis; none where even a slope of zero belongs to the interval.
    fn least_slope(&self) -> Option<f64> {
        let inside = |slope: f64| self.over_positions(slope) >= self.least;
        if inside(0.0) {
            return None;
        }
        let far = (-4..60).map(|k| 2.0_f64.powi(k)).find(|slope| inside(*slope))?;
        Some(bisected([far, 0.0], HALVINGS, inside)[0])
    }

    /// The largest value over the slopes, theta given.
    fn over_slopes(&self, theta: f64) -> f64 {
        let at = |slope: f64| self.sum(|s| (slope * (s - theta), s - theta));
        let flat = at(0.0);
        // It is concave in the slope: where it falls from zero on, zero is best.
        if flat.gradient[0] <= 0.0 {
            return flat.value;
        }
        let on = |slope: f64| (slope >= 0.0).then(|| at(slope));
        self.largest(1.0, on).unwrap_or(flat.value)
    }

    /// The largest value over the positions, the slope given.
    fn over_positions(&self, slope: f64) -> f64 {
        let at = |position: f64| self.sum(|s| (slope * s + position, 1.0));
        self.largest(0.0, |position| Some(at(position))).unwrap_or(f64::NEG_INFINITY)
    }

    fn largest(&self, start: f64, function: impl Fn(f64) -> Option<Point>) -> Option<f64> {
        let runs: f64 = self.counts.iter().map(|[_, fail, stand]| fail + stand).sum();
        let scaled = |[x, _]: [f64; 2]| {
            let Point { value, gradient, curvature } = function(x)?;
            let finite = value.is_finite() && curvature[0].is_finite();
            finite.then_some(Point {
                value: value / runs,
                gradient: gradient.map(|g| g / runs),
                // The second number takes no part.
                curvature: [curvature[0] / runs, 0.0, 1.0],
            })
        };
        newton::maximum([start, 0.0], scaled).and_then(|[x, _]| Some(function(x)?.value))
    }

    /// The logarithm of the likelihood as a function of one number, by u and the derivative of u at each level.
    fn sum(&self, of: impl Fn(f64) -> (f64, f64)) -> Point {
        let (mut value, mut gradient, mut curvature) = (0.0, 0.0, 0.0);
        for [s, fail, stand] in &self.counts {
            let (u, by) = of(*s);
            for (count, ln) in [fail, stand].into_iter().zip(probit(u)) {
                if *count > 0.0 {
                    value += count * ln.value;
                    gradient += count * ln.slope * by;
                    curvature += count * ln.curvature * by * by;
                }
            }
        }
        Point { value, gradient: [gradient, 0.0], curvature: [curvature, 0.0, 1.0] }
    }
}
