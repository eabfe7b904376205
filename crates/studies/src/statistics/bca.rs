//! The ends of a bootstrap's interval of 95 %, corrected for bias and acceleration: Efron (1987), J. Am. Stat. Assoc.
//! 82:171-185.

use super::normal;
use super::quantile::Sorted;

/// Sets below which the 2.5 % and 97.5 % points are beyond the smallest and the largest value.
pub const FEWEST: u32 = 39;
/// Standard deviations within which 95 % are.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

/// A sixth of the skewness of the estimates without one record each; zero where they are all equal, or one is infinite.
pub fn acceleration(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let power = |n| values.iter().map(|value| (mean - value).powi(n)).sum::<f64>();
    Some(power(3) / (6.0 * power(2).powf(1.5))).filter(|a| a.is_finite()).unwrap_or(0.0)
}

/// The points in the place of 2.5 % and 97.5 %: with z_0 the deviation that corresponds to the share of values below the
/// estimate, and a the acceleration, those of Phi(z_0 + (z_0 + z)/(1 - a (z_0 + z))), z = -1.96 and 1.96. They are
/// values of ranks p (N + 1), between two ranks in proportion (Davison & Hinkley 1997, Bootstrap Methods and their
/// Application, section 5.3), and not beyond the smallest and the largest.
pub fn ends(values: Vec<f64>, estimate: f64, acceleration: f64) -> [Option<f64>; 2] {
    if values.len() < FEWEST as usize {
        return [None; 2];
    }
    let sorted = Sorted::of(values);
    let values = sorted.values();
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
        // Between two infinite values there is no number.
        sorted.at_rank(rank).filter(|value| !value.is_nan())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values 1 to `count`.
    fn values(count: u32) -> Vec<f64> {
        (1..=count).map(f64::from).collect()
    }

    #[test]
    fn ends_are_between_ranks_and_open_at_an_infinite_value() {
        let near = |found: [Option<f64>; 2], wanted: [f64; 2]| {
            found.iter().zip(wanted).all(|(found, wanted)| (found.unwrap() - wanted).abs() < 1e-6)
        };
        assert_eq!(ends(values(38), 19.5, 0.0), [None, None]);
        assert!(near(ends(values(39), 20.0, 0.0), [1.0, 39.0]));
        assert!(near(ends(values(99), 50.0, 0.0), [2.5, 97.5]));
        let mut open = values(99);
        open[98] = f64::INFINITY;
        assert!(near(ends(open.clone(), 50.0, 0.0), [2.5, 97.5]));
        open[97] = f64::INFINITY;
        assert_eq!(ends(open, 50.0, 0.0)[1], Some(f64::INFINITY));
    }

    #[test]
    fn ends_move_with_the_estimate() {
        // Phi(0.25) of the values are below: half a deviation is added to either point.
        let count = 9999;
        let estimate = normal::cdf(0.25) * 1.0e4;
        let wanted = [-1.0, 1.0].map(|side| normal::cdf(0.5 + side * DEVIATIONS) * 1.0e4);
        for (found, wanted) in ends(values(count), estimate, 0.0).into_iter().zip(wanted) {
            assert!((found.unwrap() - wanted).abs() < 3.0, "{found:?} {wanted}");
        }
        assert_eq!(ends(values(100), 1.0e3, 0.0), [Some(100.0); 2]);
        // A positive skewness moves both points up.
        let skewed = ends(values(count), 5000.0, 0.1);
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
}
