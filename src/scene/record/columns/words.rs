//! The words that stand above plain numbers: in which of them a unit, a direction, a step or a count is stated.

use super::super::numbers::{after, number};
use super::super::times::Clock;
use super::super::{Component, Units};

/// Names of a column of times.
const TIMES: [&str; 7] = ["time", "times", "t", "zeit", "temps", "tiempo", "tempo"];

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

/// Directions that mean nothing else where they stand in capitals.
const DIRECTIONS: [&str; 8] = ["UD", "U-D", "NS", "N-S", "EW", "E-W", "NORTH-SOUTH", "EAST-WEST"];

/// Words of a column's name beside its direction.
const BESIDE: [&str; 12] = [
    "a",
    "ag",
    "component",
    "comp",
    "comp.",
    "motion",
    "ground",
    "in",
    "of",
    "the",
    "record",
    "direction",
];

/// What stands in the outermost brackets of a line.
fn in_brackets(line: &str) -> Vec<&str> {
    let (mut found, mut depth, mut from) = (Vec::new(), 0_usize, 0);
    for (at, c) in line.char_indices() {
        match c {
            '(' | '[' => {
                if depth == 0 {
                    from = at + 1;
                }
                depth += 1;
            }
            ')' | ']' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found.push(&line[from..at]);
                }
            }
            _ => {}
        }
    }
    if depth > 0 {
        found.push(&line[from..]);
    }
    found
}

/// A line without its brackets and what stands in them.
fn without_brackets(line: &str) -> String {
    let mut depth = 0_usize;
    let mut plain = String::new();
    for c in line.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
        if depth > 0 && !plain.ends_with(' ') {
            plain.push(' ');
        }
    }
    plain
}

fn tokens(line: &str) -> impl Iterator<Item = &str> {
    let apart = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':' | '=' | '"' | '|' | '_');
    line.split(apart).filter(|word| !word.is_empty())
}

fn is_acceleration(word: &str) -> bool {
    ["acc", "beschl", "acel", "accél"].iter().any(|begins| word.starts_with(begins))
}

/// True of names of columns: of a time or an acceleration, without a number beside them.
pub(super) fn names_columns(words: &str) -> bool {
    let plain = without_brackets(words).to_lowercase();
    let named = tokens(&plain).any(|word| is_acceleration(word) || TIMES.contains(&word));
    named && tokens(&plain).all(|word| number(word).is_none())
}

/// The words of the units of an acceleration: in brackets, `time (s), acc (cm/s^2)`; `acceleration in g`; `units: gal`.
pub(super) fn units(words: &str) -> Option<String> {
    let lower = words.to_lowercase();
    let is_time = |text: &str| Clock::named(text).is_some();
    // Brackets may hold anything.
    let bracket = in_brackets(words)
        .into_iter()
        .rev()
        .find(|text| !is_time(text) && Units::are_meant(text))
        .map(String::from);
    let within = || {
        let words = lower.get(lower.rfind(" in ")? + 4..)?.trim();
        Units::are_meant(words).then(|| words.to_string())
    };
    // In a name of a column: `acc_gal`.
    let named = || {
        lower.split([' ', ',', ';', '\t', '"']).find_map(|name| {
            let (_, unit) = name.rsplit_once('_').filter(|_| is_acceleration(name))?;
            Units::named(unit).map(|_| unit.to_string())
        })
    };
    bracket.or_else(|| after_units(words)).or_else(within).or_else(named).or_else(|| {
        // A row of units below one of names: `s;m/s2`.
        let fields: Vec<&str> = tokens(words).collect();
        match fields[..] {
            [time, unit] if is_time(time) && Units::are_meant(unit) => Some(unit.to_string()),
            _ => None,
        }
    })
}

/// The words of the units behind a key: `Units: g, dt = 0.01`.
pub(super) fn after_units(words: &str) -> Option<String> {
    let lower = words.to_lowercase();
    let at = ["units:", "units =", "units=", "unit:", "unit =", "unit=", "units are ", "units "]
        .iter()
        .find_map(|key| Some(lower.find(key)? + key.len()))?;
    // Lower case may be longer.
    let rest = if lower.len() == words.len() { words.get(at..)? } else { lower.get(at..)? };
    rest.split([',', ';', '|']).find_map(|piece| {
        let fields: Vec<&str> = piece.split_whitespace().collect();
        (1..=fields.len().min(5)).rev().find_map(|count| {
            let first = fields[..count].join(" ");
            let last = fields[fields.len() - count..].join(" ");
            [first, last].into_iter().find(|words| Units::are_meant(words))
        })
    })
}

/// The unit of the times that the name of their column has: `Time (ms)`, `t [min]`, `time in ms`, `time_ms`. Words that
/// are no known one stand there as an error.
pub(super) fn clock(words: &str) -> Option<Result<Clock, String>> {
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

/// The direction that words state: `component: UD`, a direction in capitals, `vertical acc`.
pub(super) fn component(words: &str) -> Option<Component> {
    let lower = words.to_lowercase();
    let keyed = ["component", "comp", "direction", "dir", "channel", "orientation", "azimuth"]
        .iter()
        .find_map(|key| {
            let rest = lower.strip_prefix(key)?.trim_start_matches(['.', ' ']);
            let value = rest.strip_prefix([':', '='])?;
            value.split([',', ';']).next().map(str::trim)
        });
    if let Some(value) = keyed {
        return Component::named(value).or_else(|| Component::of_channel(value));
    }
    let mut found: Vec<Component> = tokens(words)
        .map(|word| word.trim_matches(['(', ')', '[', ']', '.']))
        .filter(|word| DIRECTIONS.contains(word))
        .filter_map(|word| {
            Component::named(match word {
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
        let component = Some(word).filter(|word| word.len() > 1).and_then(Component::named);
        let component = component.filter(|_| number(word).is_none());
        directions.extend(component);
        component.is_some()
            || is_acceleration(word)
            || BESIDE.contains(&word)
            || TIMES.contains(&word)
            || Clock::named(word).is_some()
            || Units::are_meant(word)
    });
    if known {
        found.extend(directions);
    }
    let first = *found.first()?;
    found.iter().all(|one| *one == first).then_some(first)
}

/// The step that words state, s: `dt = 0.01`, `DT=.005 SEC`, `sampling rate: 200 Hz`, `time step (ms): 5`.
pub(super) fn step(words: &str) -> Option<f64> {
    let lower = words.to_lowercase();
    let of = |keys: &[&str]| keys.iter().find_map(|key| valued(&lower, key));
    let positive = |value: &f64| *value > 0.0 && value.is_finite();
    let step = of(&STEPS)
        .map(|(value, unit)| value * Clock::named(&unit).map_or(1.0, |clock| clock.seconds));
    let rate = || of(&RATES).map(|(value, _)| 1.0 / value);
    step.filter(positive).or_else(|| rate().filter(positive))
}

/// The count of samples that words state: `NPTS=4000`, `number of points: 4000`.
pub(super) fn count(words: &str) -> Option<usize> {
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
        let is_number = rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let value = after(rest, "").filter(|_| is_number)?;
        let behind =
            rest.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-'));
        let word = behind.trim_start().split(|c: char| !c.is_alphabetic()).next();
        let unit = if unit.is_empty() { word.unwrap_or_default() } else { unit };
        Some((value, unit.to_string()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_those_that_words_cannot_mean_otherwise() {
        use Component::{Down, Horizontal, Up};
        for (words, component) in [
            ("UD", Up),
            ("Time (s), vertical acc (g)", Up),
            ("t [s] Acc_UD [gal]", Up),
            ("component: UD", Up),
            ("channel = HNZ", Up),
            ("time;acc down (m/s2)", Down),
            ("time acc_up", Up),
            ("Time (s) EW (cm/s2)", Horizontal),
            ("time, E-W", Horizontal),
            ("acc_ns", Horizontal),
            ("Kobe JMA NS", Horizontal),
            ("Acceleration (UD) in gal", Up),
            ("north acceleration in g", Horizontal),
        ] {
            assert_eq!(component_of(words), Some(component), "{words}");
        }
        for words in [
            "North Palm Springs",
            "scaled up acc (g)",
            "time (s) acc (g)",
            "rotated from NS and UD",
            "Vertical array 3",
            "t (ns) a (g)",
            "time (s), acc_z (g)",
            "a v",
            "down the hill",
        ] {
            assert_eq!(component_of(words), None, "{words}");
        }
    }

    fn component_of(words: &str) -> Option<Component> {
        component(words)
    }

    #[test]
    fn units_of_times_are_those_of_their_column() {
        for (words, wanted) in [
            ("Time (ms), Acc (g)", "ms"),
            ("t [ms] a [g]", "ms"),
            ("time in ms, acc in g", "ms"),
            ("time_ms,acc_g", "ms"),
            ("Time (min);a", "min"),
            ("Time [msec] Acc", "ms"),
            ("ms;m/s2", "ms"),
            ("time (s) acc", "s"),
        ] {
            assert_eq!(clock(words).unwrap().unwrap().word, wanted, "{words}");
        }
        assert_eq!(clock("time (ticks) acc (g)"), Some(Err("ticks".into())));
        for words in ["time acc", "t h", "acc (ms)", "timer (ms)", "time, ms/s2"] {
            assert_eq!(clock(words), None, "{words}");
        }
    }

    #[test]
    fn steps_and_counts_are_told_by_their_names() {
        for (words, wanted) in [
            ("dt = 0.01", 0.01),
            ("dt: 0.005 s", 0.005),
            ("dt=5ms", 0.005),
            ("NPTS=4000, DT=0.01", 0.01),
            ("NPTS= 4000, DT= .01000 SEC", 0.01),
            ("sampling rate: 200 Hz", 0.005),
            ("time step (ms): 5", 0.005),
            ("Sampling interval 0.02 sec", 0.02),
        ] {
            assert!((step(words).unwrap() - wanted).abs() < 1e-12, "{words}");
        }
        for words in ["dt", "width=3", "adt=4", "dt: none", "fsx 3", "the step 3"] {
            assert_eq!(step(words), None, "{words}");
        }
        assert_eq!(count("NPTS=4000, DT=0.01"), Some(4000));
        assert_eq!(count("number of points: 12"), Some(12));
        assert_eq!(count("NPTS=0.5"), None);
    }

    #[test]
    fn units_stand_behind_their_key_whatever_follows() {
        for (words, wanted) in [
            ("units: gal", "gal"),
            ("Units: cm/s^2", "cm/s^2"),
            ("Units = m/s2, dt = 0.01", "m/s2"),
            ("units: g dt 0.01", "g"),
            ("units: time s, acc g", "g"),
        ] {
            assert_eq!(units(words).as_deref(), Some(wanted), "{words}");
        }
        assert_eq!(units("s;m/s2").as_deref(), Some("m/s2"));
        assert_eq!(units("time_ms,acc_g").as_deref(), Some("g"));
        for words in ["recorded in a building", "time,acc_v", "acc_ns"] {
            assert_eq!(units(words), None, "{words}");
        }
        assert!(names_columns("time acc(g)") && !names_columns("PGA acceleration: 0.3 (g)"));
    }
}
