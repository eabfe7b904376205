//! CSMIP/CDMG volume 2: channels of corrected acceleration, velocity and displacement.

use super::lines::{Lines, after, fixed, number};
use super::{Raw, RecordError, Units};

/// True where the first line opens a corrected accelerogram.
pub(crate) fn matches(text: &str) -> bool {
    text.lines()
        .next()
        .is_some_and(|line| line.trim_start().to_ascii_uppercase().starts_with("CORRECTED ACCEL"))
}

/// Width of a value, FORTRAN's F10.3.
const WIDTH: usize = 10;

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let channels = text
        .lines()
        .filter(|line| line.to_ascii_uppercase().contains("POINTS OF ACCEL DATA"))
        .count();
    let mut lines = Lines::of(text);
    lines.next("first line")?;
    lines.next("second line")?;
    let title = lines.peek().unwrap_or_default().trim().to_string();
    lines
        .seek("acceleration", |line| line.to_ascii_uppercase().contains("POINTS OF ACCEL DATA"))?;
    let at = lines.number();
    let line = lines.next("acceleration")?;
    let count = line
        .split_whitespace()
        .next()
        .and_then(number)
        .filter(|count| *count >= 2.0 && count.fract() == 0.0)
        .ok_or_else(|| RecordError::line(at, "the count of points should stand here"))?;
    let dt = after(line, "SPACED AT");
    let units = line.to_ascii_uppercase().find("UNITS:").and_then(|at| {
        let text = line.get(at + 6..)?;
        Units::named(text.split(')').next()?)
    });
    let values = lines.numbers(Some(count as usize), |line| fixed(line, WIDTH))?;
    let mut notes = Vec::new();
    if channels > 1 {
        notes.push(format!("the first of {channels} channels is taken"));
    }
    Ok(Raw { title, dt, units, values, notes })
}
