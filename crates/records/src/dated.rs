//! Rows that begin with a date or a time of day: the same rows with seconds from the first one.
//!
//! Read are `2003-01-02T03:04:05.01`, also with a blank or a separator in place of the T, slashes, points, a zone (`Z`,
//! `UTC`, `+09:00`) and quotes around; `03:04:05.01` alone; and `0 days 00:00:05.01`.

use super::RecordError;
use super::numbers::{free, number};
use super::stated::seconds;

/// A text whose rows began with dates.
pub struct Dated {
    /// The text with seconds in their place, line by line.
    pub text: String,
    /// The first of them, as it is written.
    pub first: String,
    /// When that was, s from an epoch; of a time of day from midnight.
    pub start: f64,
}

/// What a row begins with.
struct Stamp<'a> {
    date: &'a str,
    /// Time of the day, s.
    clock: f64,
    decimals: usize,
    written: &'a str,
    rest: &'a str,
}

/// The digits at the beginning of a text, and what follows.
fn digits(text: &str) -> (&str, &str) {
    text.split_at(text.bytes().take_while(u8::is_ascii_digit).count())
}

/// The date at the beginning of a row, and what follows; without one the date is empty.
fn date(row: &str) -> Option<(&str, &str)> {
    let (number, rest) = digits(row);
    if number.is_empty() {
        return None;
    }
    if rest.starts_with(':') {
        return Some(("", row));
    }
    // Pandas writes a time from the start so.
    if let Some(rest) = rest.strip_prefix(" days").or_else(|| rest.strip_prefix(" day")) {
        return Some((number, rest.trim_start_matches([',', ' '])));
    }
    let separator = rest.chars().next().filter(|c| matches!(c, '-' | '/' | '.'))?;
    let (second, rest) = digits(&rest[1..]);
    let rest = match rest.strip_prefix(separator) {
        Some(third) => digits(third).1,
        None => rest,
    };
    let date = &row[..row.len() - rest.len()];
    let clock = rest.trim_start_matches(['T', 't', ' ', '\t', ',', ';', '_']);
    (!second.is_empty() && clock.len() < rest.len()).then_some((date, clock))
}

fn stamp(line: &str) -> Option<Stamp<'_>> {
    let row = line.trim_start_matches(|c: char| c.is_whitespace() || c == '"' || c == '\'');
    let (date, clock) = date(row)?;
    let (hours, rest) = digits(clock);
    let (minutes, rest) = digits(rest.strip_prefix(':')?);
    let (whole, rest) = digits(rest.strip_prefix(':')?);
    // A comma is a decimal one where others separate.
    let comma = line.contains([';', '\t']).then_some(',');
    let (part, rest) = match rest.strip_prefix('.').or_else(|| rest.strip_prefix(comma?)) {
        Some(behind) => digits(behind),
        None => ("", rest),
    };
    let number = |text: &str| text.parse::<f64>().ok();
    let (h, m) = (number(hours)?, number(minutes)?);
    let s = number(&format!("{whole}.{part}0"))?;
    if h > 24.0 || m >= 60.0 || s >= 61.0 {
        return None;
    }
    let written = row[..row.len() - rest.len()].trim_end();
    let zoned = rest.trim_start_matches(' ');
    let rest =
        ["Z", "z", "UTC", "GMT"].iter().find_map(|zone| zoned.strip_prefix(zone)).unwrap_or(rest);
    let rest = offset(rest).unwrap_or(rest).trim_start_matches(['"', '\'']);
    let ends = rest.is_empty() || rest.starts_with([' ', '\t', ',', ';', '|']);
    let clock = 3600.0 * h + 60.0 * m + s;
    ends.then_some(Stamp { date, clock, decimals: part.len(), written, rest })
}

/// What follows an offset of a zone, such as `+09:00`, directly behind a time.
fn offset(rest: &str) -> Option<&str> {
    let (hours, rest) = digits(rest.strip_prefix(['+', '-'])?);
    let (minutes, rest) = digits(rest.strip_prefix(':').unwrap_or(rest));
    ((hours.len() == 2 && minutes.len() == 2) || (hours.len() == 4 && minutes.is_empty()))
        .then_some(rest)
}

/// The text with seconds in the place of the dates that its rows begin with; none where its first row has none.
///
/// # Errors
/// A row without a date below others that have one.
pub fn plain(text: &str, heading: usize) -> Result<Option<Dated>, RecordError> {
    // A heading may begin with a date, too.
    let is_row = |line: &&str| {
        stamp(line).is_some_and(|stamp| {
            free(stamp.rest).first().is_some_and(|next| number(next).is_some())
        })
    };
    let Some(first) = text.lines().take(heading).find(is_row).and_then(stamp) else {
        return Ok(None);
    };
    let decimals = text.lines().filter_map(stamp).map(|stamp| stamp.decimals).max().unwrap_or(0);
    let (mut before, mut days) = ((first.date, first.clock), 0.0);
    let mut plain = String::with_capacity(text.len());
    let mut begun = false;
    for (line, at) in text.lines().zip(1..) {
        match stamp(line) {
            Some(stamp) => {
                begun = true;
                let passed = stamp.date != before.0
                    || stamp.date.is_empty() && before.1 - stamp.clock > 43200.0;
                days += f64::from(u8::from(passed));
                before = (stamp.date, stamp.clock);
                let time = 86400.0 * days + stamp.clock - first.clock;
                plain.push_str(&format!("{time:.decimals$}"));
                plain.push_str(stamp.rest);
            }
            None if begun && line.trim_start().starts_with(|c: char| c.is_ascii_digit()) => {
                let problem = format!(
                    "no date, as '{}' is in the rows above; write the time of each row in the same way",
                    first.written
                );
                return Err(RecordError::line(at, problem));
            }
            None => plain.push_str(line),
        }
        plain.push('\n');
    }
    let start =
        seconds(&format!("{} {}", first.date, first.written.trim_start_matches(first.date)));
    let start = start.filter(|_| !first.date.is_empty()).unwrap_or(first.clock);
    Ok(Some(Dated { text: plain, first: first.written.into(), start }))
}
