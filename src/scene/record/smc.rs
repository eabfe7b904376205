//! USGS SMC: a type, text, integers, reals, comments, and values that touch.

use super::lines::{Lines, fixed};
use super::{Raw, RecordError, Units};

/// Lines of text at the start.
const TEXT: usize = 11;
/// Integers, eight to a line of columns of ten.
const INTEGERS: usize = 48;
/// Reals, five to a line of columns of fifteen.
const REALS: usize = 50;

/// True where the first line is a type with its number and the second a lone asterisk.
pub(crate) fn matches(text: &str) -> bool {
    let mut lines = text.lines();
    let (Some(first), Some(second)) = (lines.next(), lines.next()) else { return false };
    let numbered = first.trim_start().starts_with(|c: char| c.is_ascii_digit());
    numbered && first.to_ascii_uppercase().contains("ACCELEROGRAM") && second.trim() == "*"
}

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let title: Vec<&str> = text.lines().skip(3).take(3).map(str::trim).collect();
    lines.skip(TEXT);
    let at = lines.number();
    let integers = lines.numbers(Some(INTEGERS), |line| fixed(line, 10))?;
    let reals = lines.numbers(Some(REALS), |line| fixed(line, 15))?;
    let whole = |value: f64| (value >= 0.0 && value.fract() == 0.0).then_some(value as usize);
    let comments = integers.get(15).copied().and_then(whole).unwrap_or(0);
    let count =
        integers.get(16).copied().and_then(whole).filter(|count| *count >= 2).ok_or_else(|| {
            RecordError::line(at + 2, "integer 17, the count of samples, is missing")
        })?;
    let rate = reals
        .get(1)
        .copied()
        .filter(|rate| *rate > 0.0 && *rate < 1.0e5)
        .ok_or_else(|| RecordError::line(at + 6, "real 2, the sampling rate, is missing"))?;
    lines.skip(comments);
    let values = lines.numbers(Some(count), |line| fixed(line, 10))?;
    Ok(Raw {
        title: title.join(" ").split_whitespace().collect::<Vec<_>>().join(" "),
        dt: Some(1.0 / rate),
        units: Some(Units::CentimetresPerSecondSquared),
        values,
        notes: Vec::new(),
    })
}
