//! Samples that no motion of the ground has: of a constant, a counter, a flag.

/// Fewest samples that are judged.
const FEWEST: usize = 16;

/// Largest part of their range by which the samples of a counter miss a straight line.
const STRAIGHT: f64 = 5.0e-3;

/// What samples are, where they are no motion's, in words.
pub(super) fn unlikely(samples: &[f64]) -> Option<&'static str> {
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

#[cfg(test)]
mod tests {
    use super::unlikely;

    #[test]
    fn constants_counters_and_flags_are_no_motions() {
        let of = |sample: &dyn Fn(u32) -> f64| {
            unlikely(&(0..300).map(sample).collect::<Vec<f64>>()).unwrap_or_default()
        };
        assert!(of(&|_| 0.5).contains("the same"));
        assert!(of(&|k| 3.0 + 0.01 * f64::from(k)).contains("evenly"));
        // To two decimals.
        assert!(of(&|k| (0.5 * f64::from(k)).round() * 0.01).contains("evenly"));
        assert!(of(&|k| f64::from(300 - k)).contains("evenly"));
        assert!(of(&|k| if k % 7 < 3 { 1.0 } else { 0.0 }).contains("as a flag has"));
        assert_eq!(of(&|k| if k < 100 { 3.5 } else { 0.0 }), "");
        assert_eq!(of(&|k| (0.1 * f64::from(k)).sin()), "");
        assert_eq!(of(&|k| 0.01 * f64::from(k) + 0.02 * (0.5 * f64::from(k)).sin()), "");
        assert_eq!(of(&|k| f64::from(k % 3)), "");
        assert_eq!(unlikely(&[0.0, 0.1, 0.2]), None);
    }
}
