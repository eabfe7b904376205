//! The columns that lines above several of them name: which of them are accelerations.

use super::{COMMENT, directions, meaning, polarity, words};
use crate::Units;
use crate::channel::Channel;
use crate::clock::Clock;
use crate::component::Component;
use crate::hints::RecordHints;
use crate::numbers::number;

/// The names of the columns: of the last line above the rows that has as many, and neither their units alone nor a
/// statement such as `dt = 0.01`.
pub(super) fn names(text: &str, first: usize, width: usize) -> Option<(usize, Vec<String>)> {
    let above: Vec<&str> = text.lines().take(first - 1).collect();
    above.iter().enumerate().rev().find_map(|(index, line)| {
        let names = words::columns(line.trim().trim_start_matches(COMMENT));
        let states = names.iter().any(|name| name.contains(['=', ':']) || number(name).is_some());
        (names.len() == width && !are_units(&names) && !states).then_some((index + 1, names))
    })
}

/// True of the units of columns, without their names.
fn are_units(names: &[String]) -> bool {
    let is_one = |name: &String| {
        Units::are_meant(name) || Clock::named(name).is_some() || words::is_length(name)
    };
    names.iter().all(is_one)
}

/// The units of the columns in a line of their own, below that of their names.
pub(super) fn units_below(text: &str, line: usize, width: usize) -> Option<(usize, Vec<String>)> {
    let below = text.lines().nth(line)?;
    let units = words::columns(below.trim().trim_start_matches(COMMENT));
    (units.len() == width && are_units(&units)).then_some((line + 1, units))
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
    let is_channel = |name: &String| meaning::is_channel(name) && !polarity::is_sentence(name);
    named.is_some_and(|(_, names)| names.iter().all(is_channel))
}

/// True of names in which a lone `D` can only be down: beside north and east, without another vertical.
fn is_north_east_down(names: &[String]) -> bool {
    let points =
        |azimuth| names.iter().any(|name| directions::azimuth_of_column(name) == Some(azimuth));
    let is_vertical =
        |name: &String| directions::of_column(name).is_some_and(Component::is_vertical);
    points(0.0) && points(90.0) && !names.iter().any(is_vertical)
}

/// The columns that are accelerations by their names: where one says so, only those that do; else those whose names are
/// directions.
pub(super) fn channels<'a>(names: &'a [String], hints: &RecordHints) -> Vec<Channel<'a>> {
    let says = names.iter().any(|name| words::says_acceleration(name));
    // Beside a z the letters x and y are directions.
    let is_letter =
        |name: &str, letters: &[&str]| letters.contains(&&*words::direction(name).to_lowercase());
    let has_z = names.iter().any(|name| is_letter(name, &["z"]));
    let is_horizontal = |name: &str| has_z && is_letter(name, &["x", "y"]);
    let is_down = |name: &str| is_letter(name, &["d"]) && is_north_east_down(names);
    let asked = hints.channel.as_deref().is_some_and(|asked| asked.trim().parse::<u32>().is_ok());
    let is_channel = |name: &str| match says {
        true => words::says_acceleration(name),
        // One that is chosen by its number need not be understood.
        false => {
            let is_one = meaning::is_channel(name) || is_horizontal(name) || is_down(name) || asked;
            is_one && !words::says_integral(name)
        }
    };
    let numbered = (1..).zip(names).filter(|(_, name)| is_channel(name));
    let channel = |(number, name): (u32, &'a String)| Channel {
        number: Some(number),
        word: words::direction(name),
        component: directions::of_column(name)
            .or_else(|| is_horizontal(name).then_some(Component::Horizontal))
            .or_else(|| is_down(name).then_some(Component::Down)),
        before: 0,
        text: name,
    };
    numbered.map(channel).collect()
}
