//! The step and the count of samples that words above plain numbers state.

use crate::clock::Clock;
use crate::numbers::after;

/// Names of a step in a statement of it, and of a rate; longer ones first.
const STEPS: [&str; 8] = [
    "sampling interval",
    "sampling period",
    "sample interval",
    "time interval",
    "time step",
    "timestep",
    "delta t",
    "dt",
];
const RATES: [&str; 4] = ["sampling rate", "sampling frequency", "sample rate", "fs"];

/// Names of a count in a statement of it.
const COUNTS: [&str; 5] =
    ["npts", "ndata", "number of points", "number of samples", "number of data"];

/// The step that words state, s: `dt = 0.01`, `DT=.005 SEC`, `sampling rate: 200 Hz`, `time step (ms): 5`.
pub fn step(words: &str) -> Option<f64> {
    let lower = words.to_lowercase();
    let of = |keys: &[&str]| keys.iter().find_map(|key| valued(&lower, key));
    let positive = |value: &f64| *value > 0.0 && value.is_finite();
    let step = of(&STEPS)
        .map(|(value, unit)| value * Clock::named(&unit).map_or(1.0, |clock| clock.seconds));
    let rate = || of(&RATES).map(|(value, _)| 1.0 / value);
    step.filter(positive).or_else(|| rate().filter(positive))
}

/// The count of samples that words state: `NPTS=4000`, `number of points: 4000`.
pub fn count(words: &str) -> Option<usize> {
    let lower = words.to_lowercase();
    let (value, _) = COUNTS.iter().find_map(|key| valued(&lower, key))?;
    (value >= 2.0 && value.fract() == 0.0 && value < 1.0e9).then_some(value as usize)
}

/// The number behind a key, and the word of its unit, in brackets before it or after it.
fn valued(lower: &str, key: &str) -> Option<(f64, String)> {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    lower.match_indices(key).find_map(|(at, _)| {
        let rest = &lower[at + key.len()..];
        if is_letter(lower[..at].chars().next_back()) || is_letter(rest.chars().next()) {
            return None;
        }
        let rest = rest.trim_start();
        let (unit, rest) = match rest.strip_prefix(['(', '[']) {
            Some(inside) => inside.split_once([')', ']'])?,
            None => ("", rest),
        };
        let rest = rest.trim_start().trim_start_matches([':', '=']).trim_start();
        let digits = rest.strip_prefix('-').unwrap_or(rest);
        let is_number = digits.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let value = after(rest, "").filter(|_| is_number)?;
        let behind =
            rest.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-'));
        let word = behind.trim_start().split(|c: char| !c.is_alphabetic()).next();
        let unit = if unit.is_empty() { word.unwrap_or_default() } else { unit };
        Some((value, unit.to_string()))
    })
}
