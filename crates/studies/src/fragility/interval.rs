//! Intervals by resampling records.

use rayon::prelude::*;

use super::draws::multipliers;
use super::fit::{Fit, Lognormal};
use crate::uncertain::normal;

/// How records are resampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// How many sets are drawn. Fewer than [`FEWEST`] give no interval.
    pub replicates: u32,
    /// What the draws start from: equal seeds give equal intervals.
    pub seed: u64,
}

/// Sets below which the 2.5 % and 97.5 % points are beyond the smallest and the largest value.
pub const FEWEST: u32 = 39;
/// Sets that a thread takes at once: fewer cost more to hand over than to fit.
const AT_ONCE: usize = 32;

/// Standard deviations within which 95 % are.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

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

/// Draws sets of as many records with replacement, fits each, and takes the percentiles of theta and beta, corrected for
/// bias and acceleration (Efron 1987, J. Am. Stat. Assoc. 82, 171-185); for the acceleration each record is left out
/// once. The plain percentiles are too low for beta, which resampling makes smaller.
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
    let draw = |replicate: u32| refit(&multipliers(records, settings.seed, replicate));
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
    let theta = percentiles(thetas, estimate.theta, theta_bends)
        .map(|theta| theta.filter(|theta| *theta > 0.0 && theta.is_finite()));
    Interval { theta, beta: percentiles(betas, estimate.beta, beta_bends), without_fit }
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

/// A sixth of the skewness of the estimates without one record each; zero where they are all equal, or one is infinite.
fn acceleration(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let power = |n| values.iter().map(|value| (mean - value).powi(n)).sum::<f64>();
    Some(power(3) / (6.0 * power(2).powf(1.5))).filter(|a| a.is_finite()).unwrap_or(0.0)
}

/// The points in the place of 2.5 % and 97.5 %: with z_0 the deviation that corresponds to the share of values below the
/// estimate, and a the acceleration, those of Phi(z_0 + (z_0 + z)/(1 - a (z_0 + z))), z = -1.96 and 1.96. They are
/// values of ranks p (N + 1), between two ranks in proportion (Davison & Hinkley 1997, Bootstrap Methods and their
/// Application, section 5.3), and not beyond the smallest and the largest.
fn percentiles(mut values: Vec<f64>, estimate: f64, acceleration: f64) -> [Option<f64>; 2] {
    if values.len() < FEWEST as usize {
        return [None; 2];
    }
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let below = values.partition_point(|value| *value < estimate) as f64;
    let equal = values.partition_point(|value| *value <= estimate) as f64 - below;
    // Half of those that equal it; never all or none, which would have no number of deviations.
    let share = ((below + 0.5 * equal) / count).clamp(0.5 / count, 1.0 - 0.5 / count);
    let shift = normal::quantile(share);
    [-DEVIATIONS, DEVIATIONS].map(|deviation| {
        let moved = shift + deviation;
        // The correction is one of small a; where it would turn around, the last value is meant.
        let point = shift + moved / (1.0 - acceleration * moved).max(0.1);
        let rank = normal::cdf(point) * (count + 1.0) - 1.0;
        let rank = rank.clamp(0.0, count - 1.0);
        let place = rank.floor() as usize;
        let (from, to) = (values[place], values[(place + 1).min(values.len() - 1)]);
        let value = from + (rank - place as f64) * (to - from);
        // Between two infinite values there is no number.
        Some(value).filter(|value| !value.is_nan())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::fit::Gap;

    /// The values 1 to `count`.
    fn values(count: u32) -> Vec<f64> {
        (1..=count).map(f64::from).collect()
    }

    #[test]
    fn percentiles_are_between_ranks_and_open_at_an_infinite_value() {
        let near = |found: [Option<f64>; 2], wanted: [f64; 2]| {
            found.iter().zip(wanted).all(|(found, wanted)| (found.unwrap() - wanted).abs() < 1e-6)
        };
        assert_eq!(percentiles(values(38), 19.5, 0.0), [None, None]);
        assert!(near(percentiles(values(39), 20.0, 0.0), [1.0, 39.0]));
        assert!(near(percentiles(values(99), 50.0, 0.0), [2.5, 97.5]));
        let mut open = values(99);
        open[98] = f64::INFINITY;
        assert!(near(percentiles(open.clone(), 50.0, 0.0), [2.5, 97.5]));
        open[97] = f64::INFINITY;
        assert_eq!(percentiles(open, 50.0, 0.0)[1], Some(f64::INFINITY));
    }

    #[test]
    fn percentiles_move_with_the_estimate() {
        // Phi(0.25) of the values are below: half a deviation is added to either point.
        let count = 9999;
        let estimate = normal::cdf(0.25) * 1.0e4;
        let wanted = [-1.0, 1.0].map(|side| normal::cdf(0.5 + side * DEVIATIONS) * 1.0e4);
        for (found, wanted) in percentiles(values(count), estimate, 0.0).into_iter().zip(wanted) {
            assert!((found.unwrap() - wanted).abs() < 3.0, "{found:?} {wanted}");
        }
        assert_eq!(percentiles(values(100), 1.0e3, 0.0), [Some(100.0); 2]);
        // A positive skewness moves both points up.
        let skewed = percentiles(values(count), 5000.0, 0.1);
        for (found, side) in skewed.into_iter().zip([-DEVIATIONS, DEVIATIONS]) {
            let wanted = normal::cdf(side / (1.0 - 0.1 * side)) * 1.0e4;
            assert!((found.unwrap() - wanted).abs() < 3.0, "{found:?} {wanted}");
        }
    }

    #[test]
    fn acceleration_is_a_sixth_of_the_skewness() {
        // Means of x without one: the values 1, 1, 4 have the deviations -1, -1, 2, those of the rest half, turned around.
        assert!((acceleration(&[2.5, 2.5, 1.0]) - 6.0 / (6.0 * 6.0_f64.powf(1.5))).abs() < 1.0e-12);
        assert_eq!(acceleration(&[1.0; 4]), 0.0);
        assert_eq!(acceleration(&[1.0, f64::INFINITY]), 0.0);
        assert_eq!(acceleration(&[]), 0.0);
    }

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
        let drawn = (0..4000).map(|k| mean(&multipliers(60, 1, k))).collect();
        let a = skewness(3) / (6.0 * skewness(2).powf(1.5));
        assert!(a > 0.02, "{a}");
        for (found, wanted) in found.theta.into_iter().zip(percentiles(drawn, estimate.theta, a)) {
            assert!((found.unwrap() / wanted.unwrap() - 1.0).abs() < 1.0e-9);
        }
    }
}
