//! Samples that no motion of the ground has: of a constant, a counter, a flag.

/// Fewest samples that are judged.
const FEWEST: usize = 16;

/// Largest part of their range by which the samples of a counter miss a straight line.
const STRAIGHT: f64 = 5.0e-3;

/// What samples are, where they are no motion's, in words.
pub fn unlikely(samples: &[f64]) -> Option<&'static str> {
    let (first, last) = (*samples.first()?, *samples.last()?);
    if samples.len() < FEWEST {
        return None;
    }
    if samples.iter().all(|sample| *sample == first) {
        return Some("every sample is the same");
    }
    let slope = (last - first) / (samples.len() - 1) as f64;
    let straight = |(at, sample): (usize, &f64)| {
        (sample - first - slope * at as f64).abs() <= STRAIGHT * (last - first).abs()
    };
    if samples.iter().enumerate().all(straight) {
        return Some("the samples grow evenly, as a time or a counter does");
    }
    // A rectangular pulse has two values, too.
    let other = samples.iter().copied().find(|sample| *sample != first)?;
    let flag = first.fract() == 0.0 && (first - other).abs() == 1.0;
    let two = samples.iter().all(|sample| *sample == first || *sample == other);
    (flag && two).then_some("the samples have two neighbouring whole numbers alone, as a flag has")
}
