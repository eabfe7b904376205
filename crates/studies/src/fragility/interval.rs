//! Intervals by resampling records.

use rayon::prelude::*;

use super::fit::{Fit, Lognormal};
use crate::statistics::Bootstrap;
use crate::statistics::bca::{FEWEST, acceleration, ends};

/// Sets that a thread takes at once: fewer cost more to hand over than to fit.
const AT_ONCE: usize = 32;

/// What resampling gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower and upper bound of theta; none where it is open at that end.
    pub theta: [Option<f64>; 2],
    /// Those of beta.
    pub beta: [Option<f64>; 2],
    /// Sets without a curve.
    pub without_fit: usize,
}

/// Draws sets of as many records with replacement, fits each, and takes the ends of theta and beta, corrected for
/// bias and acceleration ([`ends`]); for the acceleration each record is left out once. The plain percentiles are too low for beta, which resampling makes smaller.
///
/// Records are drawn, not runs: the runs of a record belong together. `refit` gets how often each record is drawn.
///
/// A set without a curve says something where it is separable: a gap with two ends counts with its middle and with a beta
/// of zero, which are the limits of the likelihood; a set in which none fails counts as theta without bound, one
/// in which all fail as theta of zero, both without a beta. Left out, they would make the interval too narrow on that
/// side. An interval that reaches such a theta is open there. The other sets without a curve do not count.
pub fn bootstrap(
    records: usize,
    settings: &Bootstrap,
    estimate: Lognormal,
    refit: impl Fn(&[u32]) -> Fit + Sync,
) -> Interval {
    let draw = |replicate: u32| refit(&settings.multipliers(records, replicate));
    let fits: Vec<Fit> =
        (0..settings.replicates).into_par_iter().with_min_len(AT_ONCE).map(draw).collect();
    let (thetas, betas) = values(&fits);
    let without_fit = fits.iter().filter(|fit| fit.curve().is_none()).count();
    if thetas.len() < FEWEST as usize {
        return Interval { theta: [None; 2], beta: [None; 2], without_fit };
    }
    let without = |left_out: usize| {
        refit(&(0..records).map(|record| u32::from(record != left_out)).collect::<Vec<_>>())
    };
    let fits: Vec<Fit> = (0..records).into_par_iter().with_min_len(AT_ONCE).map(without).collect();
    let [theta_bends, beta_bends] =
        <[_; 2]>::from(values(&fits)).map(|values| acceleration(&values));
    let theta = ends(thetas, estimate.theta, theta_bends)
        .map(|theta| theta.filter(|theta| *theta > 0.0 && theta.is_finite()));
    Interval { theta, beta: ends(betas, estimate.beta, beta_bends), without_fit }
}

/// What fits say of theta and of beta.
fn values(fits: &[Fit]) -> (Vec<f64>, Vec<f64>) {
    let (mut thetas, mut betas) = (Vec::new(), Vec::new());
    for fit in fits {
        let (theta, beta) = match fit {
            Fit::Fitted(curve) => (Some(curve.theta), Some(curve.beta)),
            Fit::Separable(gap) => match (gap.stands, gap.fails) {
                (Some(_), Some(_)) => (gap.middle(), Some(0.0)),
                (Some(_), None) => (Some(f64::INFINITY), None),
                (None, _) => (Some(0.0), None),
            },
            _ => (None, None),
        };
        thetas.extend(theta);
        betas.extend(beta);
    }
    (thetas, betas)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::fit::Gap;

    /// Of two records: the first twice, each once, the second twice.
    fn of_two(first: Fit, second: Fit) -> Interval {
        let curve = Lognormal { theta: 1.0, beta: 0.4 };
        let refit = |times: &[u32]| match times {
            [2, 0] => first,
            [0, 2] => second,
            _ => Fit::Fitted(curve),
        };
        bootstrap(2, &Bootstrap { replicates: 400, seed: 4 }, curve, refit)
    }

    #[test]
    fn sets_without_a_curve_count_as_what_they_say() {
        let gap = |stands, fails| Fit::Separable(Gap { stands, fails });
        let found = of_two(gap(Some(4.0), None), gap(Some(0.25), Some(1.0)));
        // A quarter of the sets each: none fails, so that theta is open above; a step at 0.5.
        assert_eq!(found.theta, [Some(0.5), None]);
        assert_eq!(found.beta, [Some(0.0), Some(0.4)]);
        assert!(found.without_fit.abs_diff(200) < 60, "{found:?}");
        let found = of_two(gap(None, Some(0.1)), Fit::NotIncreasing);
        assert_eq!((found.theta, found.beta), ([None, Some(1.0)], [Some(0.4); 2]));
        let found = of_two(Fit::TooFewFailed, Fit::NotIncreasing);
        assert_eq!((found.theta, found.beta), ([Some(1.0); 2], [Some(0.4); 2]));
    }

    #[test]
    fn the_interval_of_a_mean_is_corrected_for_its_skewness() {
        // theta is the mean of values that are skewed, so that the corrected interval reaches further up than down, and
        // as far as ranks by the formula say.
        let values: Vec<f64> = (0..60).map(|k| (0.08 * f64::from(k)).exp()).collect();
        let mean = |times: &[u32]| {
            let sum: f64 = values.iter().zip(times).map(|(v, n)| v * f64::from(*n)).sum();
            sum / f64::from(times.iter().sum::<u32>())
        };
        let fit = |times: &[u32]| Fit::Fitted(Lognormal { theta: mean(times), beta: 1.0 });
        let estimate = Lognormal { theta: mean(&[1; 60]), beta: 1.0 };
        let settings = Bootstrap { replicates: 4000, seed: 1 };
        let found = bootstrap(60, &settings, estimate, fit);
        let skewness = |n| values.iter().map(|v| (v - estimate.theta).powi(n)).sum::<f64>();
        let drawn = (0..4000).map(|k| mean(&settings.multipliers(60, k))).collect();
        let a = skewness(3) / (6.0 * skewness(2).powf(1.5));
        assert!(a > 0.02, "{a}");
        for (found, wanted) in found.theta.into_iter().zip(ends(drawn, estimate.theta, a)) {
            assert!((found.unwrap() / wanted.unwrap() - 1.0).abs() < 1.0e-9);
        }
    }
}
