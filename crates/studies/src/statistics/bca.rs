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
