//! COSMOS V1.20, volumes 1 and 2.

use super::lines::{Lines, after, fixed, free};
use super::{Raw, RecordError, Units};

/// True where the first line names the format.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(|line| line.to_ascii_lowercase().contains("(format v"))
}

/// The first whole number of a line.
fn leading_count(line: &str) -> Option<usize> {
    line.split_whitespace().next()?.parse().ok()
}

/// The width of a field of a FORTRAN format such as `Format=(1E15.6)`.
fn width(line: &str) -> Option<usize> {
    let upper = line.to_ascii_uppercase();
    let format = &upper[upper.find("FORMAT")?..];
    let inside = &format[format.find('(')? + 1..];
    let letter = inside.find(['E', 'F', 'I'])?;
    let digits: String = inside[letter + 1..].chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let first = lines.next("first line")?;
    if !first.to_ascii_lowercase().contains("acceleration") {
        return Err(RecordError::line(1, "this is no acceleration; give the acceleration file"));
    }
    let title = lines.peek().unwrap_or_default().trim().to_string();
    lines
        .seek("real header", |line| line.contains("Real-header") || line.contains("real-header"))?;
    let number = lines.number();
    let line = lines.next("real header")?;
    let bad = || RecordError::line(number, "the count of real-header values should stand here");
    let count = leading_count(line).ok_or_else(bad)?;
    let cut = width(line).unwrap_or(15);
    let reals = lines.numbers(Some(count), |line| fixed(line, cut))?;
    lines.seek("samples", |line| line.contains(" pts,"))?;
    let number = lines.number();
    let line = lines.next("count of samples")?;
    let count = leading_count(line)
        .ok_or_else(|| RecordError::line(number, "the count of samples should stand here"))?;
    let units = line.to_ascii_lowercase().find("units=").and_then(|at| {
        let text = line.get(at + 6..)?;
        Units::named(text.split(['(', ',']).next()?)
    });
    // The time between samples, in ms, is among the values 61 to 64 of the real header (its place
    // moved between writers); it is the one that agrees with the stated, rounded duration.
    let duration = after(line, "APPROX").filter(|d| *d > 0.0).map(|d| d / count.max(1) as f64);
    let stated = reals
        .iter()
        .skip(60)
        .take(4)
        .map(|ms| ms * 1.0e-3)
        .find(|dt| duration.is_some_and(|rough| (dt - rough).abs() < 0.02 * rough));
    let mut notes = Vec::new();
    if stated.is_none() {
        notes.push("time between samples taken from the stated duration".to_string());
    }
    let dt = stated.or(duration);
    let cut = width(line);
    let values = lines.numbers(Some(count), |line| match cut {
        Some(cut) => fixed(line, cut),
        None => free(line),
    })?;
    Ok(Raw { title, dt, units, values, notes })
}
