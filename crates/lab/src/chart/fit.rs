//! Slopes of a chart's lines.

/// The slope of a line through points of a log-log chart, coarse ones first, by least squares, over
/// those that tell of it: small errors, down to the first that is near the floor which rounding
/// sets (a factor of [`CLEAR`] above the least error). None with fewer than three, or where they
/// lie above one another.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let least = points.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
    let logs: Vec<(f64, f64)> = points
        .iter()
        .skip_while(|point| !(point.1 < COARSE))
        .take_while(|point| point.1 > CLEAR * least)
        .map(|(x, y)| (x.ln(), y.ln()))
        .collect();
    let (first, last) = (logs.first()?, logs.last()?);
    if logs.len() < 3 || (first.0 - last.0).abs() < APART.ln() {
        return None;
    }
    let count = logs.len() as f64;
    let mean_x = logs.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = logs.iter().map(|p| p.1).sum::<f64>() / count;
    let square: f64 = logs.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let product: f64 = logs.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    Some(product / square)
}

/// Errors within this factor of the least are its floor.
pub const CLEAR: f64 = 8.0;
/// Errors above this are no longer small: no order shows in them.
const COARSE: f64 = 1.0e-2;
/// Factor in step or time over which a slope is one.
const APART: f64 = 2.0;
