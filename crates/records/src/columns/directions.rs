//! The direction of a component that words above plain numbers state.

use super::polarity::Ways;
use super::words::{
    self, TIMES, dashes, is_acceleration, listed, lower, tokens, without_brackets, without_units,
};
use super::{alarm, polarity};
use crate::clock::Clock;
use crate::numbers::number;
use crate::{Component, Units, component};

/// Directions that mean nothing else where they stand in capitals.
const DIRECTIONS: [&str; 8] = ["UD", "U-D", "NS", "N-S", "EW", "E-W", "NORTH-SOUTH", "EAST-WEST"];

/// Words of a column's name beside its direction.
const BESIDE: &str = "a ag component comp comp. motion ground in of the record direction unit";

/// Numbers of channels are below it; above it they are azimuths.
const MOST_CHANNELS: f64 = 25.0;

/// A component, and its azimuth where it is horizontal and that is known.
type Direction = (Component, Option<f64>);

/// What stands behind a key of a direction: `ud` of `component: UD`.
pub(super) fn keyed(words: &str) -> Option<String> {
    const KEYS: [&str; 7] =
        ["component", "comp", "direction", "dir", "channel", "orientation", "azimuth"];
    let lower = lower(words);
    let rest = KEYS.iter().find_map(|key| {
        let rest = lower.strip_prefix(key)?.trim_start_matches(['.', ' ']);
        rest.strip_prefix([':', '='])
    })?;
    rest.split([',', ';']).next().map(|value| value.trim().to_string())
}

/// The direction that words state: `component: UD`, a direction in capitals, `vertical acc`.
pub fn stated(words: &str) -> Option<Direction> {
    let words = &dashes(words);
    let lower = words.to_lowercase();
    let told = |word: &str| Some((Component::named(word)?, component::azimuth(word)));
    if let Some(value) = &keyed(words) {
        // A channel may be counted.
        if lower.starts_with("ch") && number(value).is_some_and(|number| number < MOST_CHANNELS) {
            return None;
        }
        let channel = || Some((Component::of_channel(value)?, component::azimuth(value)));
        return told(value).or_else(channel);
    }
    let mut found: Vec<Direction> = tokens(words)
        .map(|word| word.trim_matches(['(', ')', '[', ']', '.']))
        .filter(|word| DIRECTIONS.contains(word))
        .filter_map(|word| {
            told(match word {
                "NORTH-SOUTH" => "NS",
                "EAST-WEST" => "EW",
                word => word,
            })
        })
        .collect();
    // Words such as up mean a direction where nothing else stands beside them than what a column is called.
    let plain = without_brackets(&lower);
    let mut directions = Vec::new();
    let known = tokens(&plain).all(|word| {
        // Of single letters z alone is no other thing.
        let direction = Some(word).filter(|word| word.len() > 1 || *word == "z").and_then(told);
        let direction = direction.filter(|_| number(word).is_none());
        directions.extend(direction);
        direction.is_some()
            || is_acceleration(word)
            || listed(BESIDE, word)
            || TIMES.contains(&word)
            || Clock::named(word).is_some()
            || Units::are_meant(word)
    });
    if known {
        found.extend(directions);
    }
    let (first, azimuth) = *found.first()?;
    let azimuth = azimuth.filter(|_| found.iter().all(|(_, other)| *other == azimuth));
    found.iter().all(|(one, _)| *one == first).then_some((first, azimuth))
}

/// The azimuth that a column's name tells: of a number alone three digits, as others count columns.
pub fn azimuth_of_column(name: &str) -> Option<f64> {
    let of = |word: &str| {
        let counts = word.len() < 3 && number(word).is_some();
        component::azimuth(word).filter(|_| !counts)
    };
    let name = dashes(name);
    let lone = || of(&lone_direction(&without_units(&name))?);
    of(without_brackets(&name).trim()).or_else(|| of(words::direction(&name))).or_else(lone)
}

/// The azimuth of a component of which a line calls ways along the ground positive: of NS that is positive south 180 degrees.
/// None where all ways are behind that which it states.
pub(super) fn azimuth_by_ways(own: Option<f64>, ways: &[f64]) -> Option<f64> {
    let between = |one: f64, other: f64| 180.0 - ((one - other).rem_euclid(360.0) - 180.0).abs();
    match (own, ways) {
        (Some(own), _) if ways.iter().any(|way| between(own, *way) < 1.0) => Some(own),
        (Some(own), _) => match ways.iter().find(|way| between(own, **way) > 179.0) {
            Some(way) => Some(*way),
            None => ways.iter().any(|way| between(own, *way) < 91.0).then_some(own),
        },
        (None, [way]) => Some(*way),
        (None, _) => None,
    }
}

/// The one word of a name that is a direction, where all besides are of a sign or a factor: `Z` of `Z*-1`, `Z_inv`, `-Z`.
fn lone_direction(name: &str) -> Option<String> {
    let name = lower(name);
    let numbered = |c: char| !c.is_alphanumeric();
    let mut found: Vec<&str> =
        name.split(numbered).filter(|word| word.contains(char::is_alphabetic)).collect();
    for word in &mut found {
        *word = alarm::glued(word).unwrap_or(word);
    }
    // Letters may be anything, unless a sign or a factor stands beside them.
    let signed = alarm::of_name(&name, Some(Component::Up));
    let is_direction =
        |word: &str| Component::named(word).is_some() && (signed || word.len() > 1 || word == "z");
    let is_beside = |word: &str| {
        is_acceleration(word)
            || listed(BESIDE, word)
            || listed("x t is to not", word)
            || alarm::of_name(word, None)
    };
    let mut directions = found.iter().filter(|word| is_direction(word));
    let (first, second) = (directions.next(), directions.next());
    let known = found.iter().all(|word| is_direction(word) || is_beside(word));
    first.filter(|_| second.is_none() && known).map(|word| word.to_string())
}

/// True of a name of which `down` is the only word beside those of an acceleration and of units.
fn is_down(name: &str) -> bool {
    let plain = without_brackets(name);
    let mut words = plain.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
    let is_way = |word: &str| ["down", "dwn"].contains(&word);
    let beside = ["a", "acc", "accel", "acceleration", "comp", "component", "ch", "channel"];
    let known = |word: &str| is_way(word) || beside.contains(&word) || Units::are_meant(word);
    words.clone().any(is_way) && words.all(known)
}

/// The direction that a column's name tells: `NS (g)`, `acc-UD`, `IWT010.UD1`, `HNZ`, `Up-Down`, `Z (down)`.
pub(super) fn of_column(name: &str) -> Option<Component> {
    let name = &without_units(&dashes(name));
    let own = of_name(name);
    match polarity::of_column(name) {
        Some(Ways { vertical: Some(way), is_stated: true, of_all, .. })
            if own.is_some_and(Component::is_vertical) || own.is_none() && !of_all =>
        {
            Some(way)
        }
        _ => own,
    }
}

/// The same without what the name says of a sign.
fn of_name(name: &str) -> Option<Component> {
    let lower = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    if is_down(&lower) {
        return Some(Component::Down);
    }
    if has(&["vert", "updown", "up-down", "up/down"]) {
        return Some(Component::Up);
    }
    let plain = without_brackets(name);
    let plain = plain.trim();
    let numbered = |word: &str| word.trim_end_matches(['1', '2']).to_string();
    let told = |word: &str| {
        let word = word.trim_end_matches("comp").trim_end_matches('.');
        Component::named(word)
            .or_else(|| Component::named(&numbered(word)))
            .or_else(|| Component::of_channel(word))
    };
    let prefixes = ["accel", "acc", "ACC", "Acc"];
    let bare = prefixes.iter().find_map(|prefix| plain.strip_prefix(prefix)).unwrap_or(plain);
    let bare = bare.trim_start_matches(['-', '_', '.', ' ', ':']);
    let last = bare.rsplit(['.', '_', ' ', ':']).next().unwrap_or_default();
    let stated = stated(name).map(|(component, _)| component);
    // Behind a blank `down` may be the end of a sentence: `5 m down`.
    let apart = bare.contains([' ', ':']);
    let last = || told(last).filter(|one| !(apart && *one == Component::Down));
    let lone = || lone_direction(plain).and_then(|word| told(&word));
    stated.or_else(|| told(bare)).or_else(last).or_else(lone)
}
