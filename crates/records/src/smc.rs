//! USGS SMC: a type, text, integers, reals, comments, and values that touch.

use super::component::Component;
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::fixed;
use super::shown::shown;
use super::stated::tidy;
use super::{Raw, RecordError, Stated, Step};

/// Lines of text at the start.
const TEXT: usize = 11;
/// Integers, eight to a line of columns of ten.
const INTEGERS: usize = 48;
/// Reals, five to a line of columns of fifteen.
const REALS: usize = 50;
/// The type that is read: the number of its first line.
const CORRECTED: &str = "2";

/// True where the first line is a type with its number and the second a lone asterisk.
pub(crate) fn matches(text: &str) -> bool {
    let mut lines = text.lines();
    let (Some(first), Some(second)) = (lines.next(), lines.next()) else { return false };
    let numbered = first.trim_start().starts_with(|c: char| c.is_ascii_digit());
    numbered && first.contains(|c: char| c.is_ascii_alphabetic()) && second.trim() == "*"
}

pub(crate) fn read(text: &str, _: &RecordHints) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let first = lines.peek().unwrap_or_default().trim();
    if !first.starts_with(CORRECTED) || !first.to_ascii_uppercase().contains("ACCEL") {
        let problem = format!(
            "'{}' of SMC is not read; give the file of its corrected acceleration (type 2)",
            shown(first)
        );
        return Err(RecordError::line(1, problem));
    }
    let head: Vec<&str> = text.lines().take(TEXT).collect();
    let title: Vec<&str> = head.iter().skip(3).take(3).map(|line| line.trim()).collect();
    lines.skip(TEXT);
    let at = lines.number();
    let integers = lines.numbers(Some(INTEGERS), |line| fixed(line, 10))?;
    let reals = lines.numbers(Some(REALS), |line| fixed(line, 15))?;
    let integer = |place: usize| integers.get(place - 1).copied();
    let whole = |value: f64| (value >= 0.0 && value.fract() == 0.0).then_some(value as usize);
    let comments = integer(16).and_then(whole).unwrap_or(0);
    let count = integer(17)
        .and_then(whole)
        .filter(|count| *count >= 2)
        .ok_or_else(|| RecordError::line(at + 2, "integer 17, the count of samples, is missing"))?;
    let rate = reals
        .get(1)
        .copied()
        .filter(|rate| *rate > 0.0 && *rate < 1.0e5)
        .ok_or_else(|| RecordError::line(at + 6, "real 2, the sampling rate, is missing"))?;
    lines.skip(comments);
    let (values, more) = lines.samples(count, |line| fixed(line, 10))?;
    let line = head.iter().find(|line| line.to_ascii_lowercase().contains("component="));
    let (station, word) = line.map_or(("", ""), |line| {
        let at = line.to_ascii_lowercase().find("component=").unwrap_or(0);
        (&line[..at], line.get(at + 10..).unwrap_or_default().trim())
    });
    // Integer 13 is the angle from upwards.
    let angle = match integer(13) {
        Some(0.0) => Some(Component::Up),
        Some(180.0) => Some(Component::Down),
        Some(90.0) => Some(Component::Horizontal),
        _ => None,
    };
    let named = Component::named(word);
    if let (Some(angle), Some(named)) = (angle, named)
        && angle.is_vertical() != named.is_vertical()
    {
        let problem = format!(
            "integer 13, the angle from upwards, and the component '{}' above contradict each other; correct one",
            shown(word)
        );
        return Err(RecordError::line(at + 1, problem));
    }
    let component = angle.or(named);
    Ok(Raw {
        title: tidy(&title.join(" ")),
        stated: Stated {
            event: tidy(head.get(3).copied().unwrap_or_default()),
            station: tidy(
                station.trim_start().trim_start_matches("station").trim_start_matches([' ', '=']),
            ),
            component,
            ..Stated::default()
        },
        step: Some(Step::exact(1.0 / rate)),
        units: Some((0, "cm/s2".into())),
        values,
        notes: more.into_iter().collect(),
    })
}
