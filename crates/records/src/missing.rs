//! Samples that stand for missing ones in many files.

/// Values that stand for a missing sample, with either sign.
const CODES: [f64; 12] =
    [99.0, 99.9, 99.99, 999.0, 999.25, 999.9, 999.99, 9999.0, 9999.9, 9999.99, 99999.0, 99999.9];

/// From which value on a code is one wherever it stands, in a file whose values are not all whole numbers.
const CLEAR: f64 = 999.0;

/// What is said of samples that are such values, as a file has them. Where they may be samples, they must differ from those
/// beside them by more than half of themselves.
pub fn told(values: &[f64]) -> Option<String> {
    let whole = values.iter().all(|value| value.fract() == 0.0);
    let is_code = |value: f64| CODES.contains(&value.abs());
    let stands_out = |at: usize, value: f64| {
        let far = |other: Option<&f64>| {
            other.is_none_or(|other| (other - value).abs() > 0.5 * value.abs())
        };
        let before = values[..at].iter().rev().find(|other| **other != value);
        let after = values[at + 1..].iter().find(|other| **other != value);
        far(before) && far(after)
    };
    let is_missing = |(at, value): &(usize, f64)| {
        is_code(*value) && (!whole && value.abs() >= CLEAR || stands_out(*at, *value))
    };
    let mut found = values.iter().copied().enumerate().filter(is_missing);
    let (first, code) = found.next()?;
    let count = 1 + found.count();
    let are = if count == 1 { "1 sample is" } else { &format!("{count} samples are") };
    Some(format!(
        "{are} exactly {code}, number {} first: such a value stands for a missing sample in many files; fill it in, or cut the \
         record there",
        first + 1
    ))
}
