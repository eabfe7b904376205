//! The words above plain numbers in which a unit is stated, of the values or of the times.

use super::meaning::is_channel;
use super::words::{TIMES, columns, in_brackets, is_acceleration, names_columns, tokens};
use crate::Units;
use crate::clock::Clock;
use crate::numbers::number;

/// The words of the units of an acceleration: in brackets, `time (s), acc (cm/s^2)`; `acceleration in g`; `units: gal`.
pub fn units(words: &str) -> Option<String> {
    let lower = words.to_lowercase();
    let is_time = |text: &str| Clock::named(text).is_some();
    // Brackets may hold anything: beside a name of a place a number is a peak.
    let names = || names_columns(words) || columns(words).iter().any(|name| is_channel(name));
    let bracket = in_brackets(words)
        .into_iter()
        .rev()
        .find(|text| {
            !is_time(text) && Units::are_meant(text) && (!Units::has_factor(text) || names())
        })
        .map(String::from);
    let within = || within(&lower).filter(|words| Units::are_meant(words)).map(String::from);
    // In a name of a column: `acc_gal`.
    let named = || {
        lower.split([' ', ',', ';', '\t', '"']).find_map(|name| {
            let (_, unit) = name.rsplit_once('_').filter(|_| is_acceleration(name))?;
            Units::named(unit).map(|_| unit.to_string())
        })
    };
    bracket.or_else(|| after_units(words)).or_else(within).or_else(named).or_else(|| {
        // A row of units below one of names: `s;m/s2`.
        match &columns(words)[..] {
            [time, unit] if is_time(time) && Units::are_meant(unit) => Some(unit.to_string()),
            _ => None,
        }
    })
}

/// What stands behind the last `in` of a line in lower case.
fn within(lower: &str) -> Option<&str> {
    Some(lower.get(lower.rfind(" in ")? + 4..)?.trim())
}

/// The units of a comment that names no columns: behind their key, or with a factor behind `in`.
pub(super) fn of_comment(words: &str) -> Option<String> {
    let lower = words.to_lowercase();
    let with_factor = || within(&lower).filter(|words| Units::has_factor(words)).map(String::from);
    after_units(words).or_else(with_factor)
}

/// The words of the units behind a key: `Units: g, dt = 0.01`.
fn after_units(words: &str) -> Option<String> {
    let lower = words.to_lowercase();
    let at = ["units:", "units =", "units=", "unit:", "unit =", "unit=", "units are ", "units "]
        .iter()
        .find_map(|key| Some(lower.find(key)? + key.len()))?;
    // Lower case may be longer.
    let rest = if lower.len() == words.len() { words.get(at..)? } else { lower.get(at..)? };
    let mut pieces = rest.split([',', ';', '|']).peekable();
    while let Some(piece) = pieces.next() {
        let unit = of_piece(piece);
        // A product may stand behind a comma: `g, x 1000`.
        let product = pieces.peek().map(|next| next.trim()).filter(|next| {
            let number = next.trim_start_matches(['x', '*', '\u{d7}']);
            number.len() < next.len()
                && number.trim_start().starts_with(|c: char| c.is_ascii_digit())
        });
        match (unit, product) {
            (Some(unit), Some(product)) => return Some(format!("{unit} {product}")),
            (Some(unit), None) => return Some(unit),
            (None, _) => {}
        }
    }
    None
}

/// The unit at the beginning or at the end of words, with a number before it that is a factor.
fn of_piece(piece: &str) -> Option<String> {
    let fields: Vec<&str> = piece.split_whitespace().collect();
    (1..=fields.len().min(5)).rev().find_map(|count| {
        let first = fields[..count].join(" ");
        let from = fields.len() - count;
        let is_factor = |at: &usize| number(fields[*at]).is_some_and(|number| number != 1.0);
        let factor = from.checked_sub(1).filter(is_factor);
        let last = fields[from..].join(" ");
        if let Some(at) = factor.filter(|_| Units::are_meant(&last)) {
            return Some(fields[at..].join(" "));
        }
        [first, last].into_iter().find(|words| Units::are_meant(words))
    })
}

/// The unit of the times that the name of their column has: `Time (ms)`, `t [min]`, `time in ms`, `time_ms`. Words that
/// are no known one stand there as an error.
pub fn clock(words: &str) -> Option<Result<Clock, String>> {
    let words = words.trim().trim_start_matches('"');
    let lower = words.to_lowercase();
    let fields: Vec<&str> = tokens(&lower).collect();
    if let [time, unit] = fields[..]
        && Units::are_meant(unit)
        && let Some(clock) = Clock::named(time.trim_matches(['(', ')', '[', ']']))
    {
        return Some(Ok(clock));
    }
    let end = lower.find(|c: char| !c.is_alphabetic()).unwrap_or(lower.len());
    let rest = TIMES.contains(&&lower[..end]).then(|| lower[end..].trim_start_matches(' '))?;
    if let Some(inside) = rest.strip_prefix(['(', '[']) {
        let inside = inside.split([')', ']']).next().unwrap_or_default();
        let unit = inside.split_whitespace().next().unwrap_or_default();
        return Some(Clock::named(unit).ok_or_else(|| inside.trim().to_string()));
    }
    let unit = rest.strip_prefix("in ").or(rest.strip_prefix(['_', '/'])).unwrap_or(rest);
    let word = unit.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
    // A bare h may be a direction.
    Clock::named(word).filter(|_| word.len() > 1 || word == "s").map(Ok)
}
