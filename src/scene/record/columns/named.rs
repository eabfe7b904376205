//! The columns that lines above several of them name: which of them are accelerations.

use super::super::Units;
use super::super::channel::Channel;
use super::super::hints::RecordHints;
use super::super::numbers::number;
use super::{COMMENT, directions, words};

/// The names of the columns: of the last line above the rows that has as many, and neither their units alone nor a
/// statement such as `dt = 0.01`.
pub(super) fn names(text: &str, first: usize, width: usize) -> Option<(usize, Vec<String>)> {
    let above: Vec<&str> = text.lines().take(first - 1).collect();
    above.iter().enumerate().rev().find_map(|(index, line)| {
        let names = words::columns(line.trim().trim_start_matches(COMMENT));
        let are_units = names.iter().all(|name| Units::are_meant(name) || name == "s");
        let states = names.iter().any(|name| name.contains(['=', ':']) || number(name).is_some());
        (names.len() == width && !are_units && !states).then_some((index + 1, names))
    })
}

/// True where words stand above the rows that state nothing known: names of columns that are not understood.
pub(super) fn is_headed(text: &str, first: usize) -> bool {
    let above = text.lines().take(first - 1).map(str::trim);
    above.filter(|line| !line.is_empty()).any(|line| {
        let plain = line.trim_start_matches(COMMENT);
        let is_comment = plain.len() < line.len();
        !is_comment && super::numbers(&super::free(line)).is_none() || words::names_columns(plain)
    })
}

/// True of a pair of columns that a heading names as two accelerations, neither of them a time.
pub(super) fn is_pair(text: &str, first: usize) -> bool {
    let named = names(text, first, 2);
    named.is_some_and(|(_, names)| names.iter().all(|name| words::is_channel(name)))
}

/// The columns that are accelerations by their names: where one says so, only those that do; else those whose names are
/// directions.
pub(super) fn channels<'a>(names: &'a [String], hints: &RecordHints) -> Vec<Channel<'a>> {
    let says = names.iter().any(|name| words::says_acceleration(name));
    let asked = hints.channel.as_deref().is_some_and(|asked| asked.trim().parse::<u32>().is_ok());
    let is_channel = |name: &str| match says {
        true => words::says_acceleration(name),
        // One that is chosen by its number need not be understood.
        false => words::is_channel(name) || asked && !words::says_integral(name),
    };
    let numbered = (1..).zip(names).filter(|(_, name)| is_channel(name));
    let channel = |(number, name): (u32, &'a String)| Channel {
        number: Some(number),
        word: words::direction(name),
        component: directions::of_column(name),
        before: 0,
        text: name,
    };
    numbered.map(channel).collect()
}
