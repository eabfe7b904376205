//! Phrases that say which way a motion is positive. Their words are of written lists, and nothing is left over.

use super::words::{in_brackets as brackets, listed, lower, without_brackets, without_units};
use crate::Component;

/// The ways that a phrase calls positive.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Ways {
    /// That of a vertical.
    pub vertical: Option<Component>,
    /// Those along the ground, degrees from north over east.
    pub ground: Vec<f64>,
    /// It speaks of the ways along the ground, too: a file beside it may be any component of a recorder.
    pub of_all: bool,
    /// It says that these ways are positive, or those of a vertical; a way alone in brackets does not.
    pub is_stated: bool,
}

const UP: &str = "up upward upwards";
const DOWN: &str = "down downward downwards dwn dn";
const POSITIVE: &str = "positive pos plus polarity convention";
const POINTS: &str = "points pointing directed oriented";
const SYSTEM: &str = "\
    axes components channels channel columns frame coordinate coordinates system order orientation reference in";
/// Words of a vertical, without its sign.
pub(super) const VERTICAL: &str = "vertical vert ver z ud hnz hlz bnz";
/// Words that change nothing in a phrase.
const FILLING: &str = "\
    is are sense and the of for ve direction directions axis component comp motion ground record acceleration accelerations \
    values ns ew to towards time t";

/// What a line says: `positive north, east, down`, `polarity: up`, `+ down`, `Z axis points down`, `vertical down`,
/// `components: N, E, D`.
pub(super) fn phrase(line: &str) -> Option<Ways> {
    ways(line).filter(|ways| ways.is_stated)
}

/// The same of what stands in brackets, where a way may stand alone: `UD (down)`, `NS (south)`.
pub(super) fn in_brackets(text: &str) -> Option<Ways> {
    ways(text)
}

/// What the name of a column says, by itself or in a bracket.
pub(super) fn of_column(name: &str) -> Option<Ways> {
    let name = without_units(name);
    let of_vertical = words(&lower(&without_brackets(&name))).any(|word| listed(VERTICAL, word));
    let in_bracket = || {
        let ways = brackets(&name).into_iter().find_map(ways)?;
        let is_stated = ways.is_stated || of_vertical && !ways.of_all;
        Some(Ways { is_stated, ..ways })
    };
    // Axes of three letters are a recorder's.
    let is_one = |ways: &Ways| !ways.of_all || !ways.ground.is_empty();
    phrase(&name).or_else(in_bracket).filter(is_one)
}

/// True of what says in words where something points, as the name of a column does not.
pub(super) fn is_sentence(text: &str) -> bool {
    words(&lower(text)).any(|word| listed(POSITIVE, word) || listed(POINTS, word))
}

/// The words of a text.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty())
}

fn ways(text: &str) -> Option<Ways> {
    let plus = text.contains(['+', '\u{ff0b}', '\u{fe62}']);
    let text = lower(text).replace('+', " positive ").replace("sign convention", "convention");
    let text = text.trim_matches(['.', '"', ' ']);
    let chars: Vec<char> = text.chars().collect();
    let is_letter = |at: Option<&char>| at.is_some_and(|c| c.is_alphabetic());
    let known = chars.iter().enumerate().all(|(at, c)| match c {
        // A dash between words is no sign.
        '-' => at > 0 && is_letter(chars.get(at - 1)) && is_letter(chars.get(at + 1)),
        c => c.is_alphabetic() || " ,:=;_()[]#".contains(*c),
    });
    if !known {
        return None;
    }
    let all: Vec<&str> = words(text)
        .flat_map(|word| if word == "ned" { vec!["n", "e", "d"] } else { vec![word] })
        .collect();
    let has = |list: &str| all.iter().any(|word| listed(list, word));
    // The sense of something is no key by itself.
    let tight = text.replace(' ', "");
    let of_sense = tight.contains("sense:") || tight.contains("sense=");
    let across = has("e w east eastward eastwards west westward westwards");
    let along = has("n s north northward northwards south southward southwards");
    // A letter for each word that counts: k of positive, w of up and down, g along the ground, p of pointing, v of a vertical.
    let mut shape = String::new();
    let mut found = Ways::default();
    for word in &all {
        let ground = match *word {
            "n" | "north" | "northward" | "northwards" => Some(0.0),
            "e" | "east" | "eastward" | "eastwards" => Some(90.0),
            "s" if across || plus => Some(180.0),
            "south" | "southward" | "southwards" => Some(180.0),
            "w" | "west" | "westward" | "westwards" => Some(270.0),
            _ => None,
        };
        let of_three = |letter: &str| *word == letter && along && across;
        let way = match word {
            word if listed(UP, word) || of_three("u") => Some(Component::Up),
            word if listed(DOWN, word) || of_three("d") => Some(Component::Down),
            _ => None,
        };
        if way.is_some() && found.vertical.is_some_and(|other| Some(other) != way) {
            return None;
        }
        found.vertical = found.vertical.or(way);
        found.ground.extend(ground);
        let letter = match word {
            _ if way.is_some() => 'w',
            _ if ground.is_some() => 'g',
            word if listed(POSITIVE, word) || *word == "sense" && of_sense => 'k',
            word if listed(POINTS, word) => 'p',
            word if listed(VERTICAL, word) => 'v',
            word if listed(FILLING, word) => continue,
            word if listed(SYSTEM, word) => 's',
            &"x" | &"y" => 'x',
            _ => return None,
        };
        if letter == 'g' || !shape.ends_with(letter) {
            shape.push(letter);
        }
    }
    found.of_all = shape.contains('g');
    let without_v = shape.replace('v', "");
    let are_ways = |text: &str| !text.is_empty() && text.chars().all(|c| c == 'g' || c == 'w');
    let positive = [without_v.strip_prefix('k'), without_v.strip_suffix('k')];
    let positive = positive.into_iter().flatten().any(are_ways);
    let points = shape.contains("pw")
        && shape.replace(['v', 'x'], "").replace("pg", "").replace("pw", "").is_empty();
    let points = points && has(&format!("axis {VERTICAL}"));
    let system = shape.replace('s', "");
    let system = are_ways(&system) && system.contains('w') && found.ground.len() > 1;
    found.is_stated = positive || points || system || shape == "vw";
    let alone = are_ways(&shape);
    // That axes point there does not say that their values are positive there.
    if !positive && !alone {
        found.ground.clear();
    }
    (found.is_stated || alone).then_some(found)
}
