//! Which way a vertical is positive, by the words above plain numbers.

use super::super::Component;

/// What words state of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Polarity {
    Way(Component),
    /// They speak of a sign, and not in words that are known.
    Unclear,
}

/// Words that change nothing between a key and its way.
const FILLING: [&str; 18] = [
    "is",
    "are",
    "axis",
    "direction",
    "dir",
    "motion",
    "motions",
    "values",
    "acceleration",
    "accelerations",
    "for",
    "of",
    "the",
    "ve",
    "means",
    "sense",
    "and",
    "to",
];

const NOT: [&str; 4] = ["not", "no", "isn", "never"];

/// Without a lone s, which is a second.
const HORIZONTAL: [&str; 15] = [
    "north",
    "south",
    "east",
    "west",
    "n",
    "e",
    "w",
    "ns",
    "ew",
    "right",
    "left",
    "forward",
    "radial",
    "tangential",
    "transverse",
];

/// What is vertical, without its sign.
const VERTICAL: [&str; 7] = ["vertical", "vert", "ver", "z", "ud", "hnz", "hlz"];

/// Words beside `positive` that speak of a size.
const SIZE: [&str; 7] = ["peak", "max", "min", "maximum", "minimum", "largest", "pga"];

/// A word of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Word {
    /// Up or down.
    Way(Component),
    /// What has a sign: true where the way after it is the positive one.
    Key(bool),
    /// An axis that points somewhere.
    Points,
    Vertical,
    Horizontal,
    Not,
    Other,
}

fn word(word: &str) -> Word {
    match word {
        "down" | "downward" | "downwards" | "dwn" => Word::Way(Component::Down),
        "up" | "upward" | "upwards" => Word::Way(Component::Up),
        "positive" | "pos" | "polarity" | "convention" => Word::Key(true),
        "negative" | "neg" => Word::Key(false),
        "points" | "pointing" | "directed" | "oriented" => Word::Points,
        _ if VERTICAL.contains(&word) => Word::Vertical,
        _ if HORIZONTAL.contains(&word) => Word::Horizontal,
        _ if NOT.contains(&word) => Word::Not,
        _ => Word::Other,
    }
}

fn opposite(way: Component) -> Component {
    match way {
        Component::Down => Component::Up,
        Component::Up => Component::Down,
        Component::Horizontal => way,
    }
}

/// The words of a line that count: `+ down` is positive down; `up-down` is no way, and neither is `down-sampled`.
fn split(line: &str) -> Vec<(&str, Word)> {
    let letters = line.split(|c: char| !c.is_alphabetic());
    let all: Vec<&str> = letters.filter(|one| !one.is_empty()).collect();
    let mut found: Vec<(&str, Word)> = Vec::new();
    let mut skipped = false;
    for (at, text) in all.iter().enumerate() {
        let next = all.get(at + 1).copied().unwrap_or_default();
        let kind = match (word(text), word(next)) {
            _ if std::mem::take(&mut skipped) => continue,
            (Word::Way(one), Word::Way(other)) if one != other => {
                skipped = true;
                Word::Vertical
            }
            (Word::Way(_), _) if ["sampled", "sampling", "hole", "to"].contains(&next) => {
                Word::Other
            }
            (kind, _) => kind,
        };
        if !FILLING.contains(text) {
            found.push((text, kind));
        }
    }
    found
}

/// A line in lower case whose signs before words are words: `+ down`, `+ve`.
fn spelled(line: &str) -> String {
    let lower = line.to_lowercase();
    let mut plain = String::with_capacity(lower.len());
    for (at, c) in lower.char_indices() {
        let after = lower[at + c.len_utf8()..].trim_start().chars().next();
        if c == '+' && !after.is_some_and(|c| c.is_ascii_digit() || c == '.') {
            plain.push_str(" positive ");
        } else {
            plain.push(c);
        }
    }
    plain.replace("-ve ", " negative ")
}

/// What the words of a line state: `positive north, east, down`, `polarity: up`, `(+ down)`, `Z axis points down`,
/// `Vertical (down)`, `not positive down`.
pub(super) fn stated(line: &str) -> Option<Polarity> {
    let line = spelled(line);
    let words = split(&line);
    let kind = |at: usize| words.get(at).map(|(_, kind)| *kind);
    let negated = |at: usize| at > 0 && kind(at - 1) == Some(Word::Not);
    let of_axis = line.contains("axis") || words.iter().any(|(_, one)| *one == Word::Vertical);
    let way = |at: usize| match kind(at)? {
        Word::Key(positive) => {
            let (before, after) = (&words[..at], &words[at + 1..]);
            beside(after.iter(), positive == negated(at))
                .or_else(|| beside(before.iter().rev(), !positive))
        }
        Word::Points if of_axis => beside(words[at + 1..].iter(), negated(at)),
        Word::Vertical if !negated(at) => match kind(at + 1) {
            Some(Word::Way(way)) => Some(way),
            _ => None,
        },
        _ => None,
    };
    // In `vertical down, positive up` the key tells.
    let is_key = |at: &usize| matches!(kind(*at), Some(Word::Key(_)));
    let by_key = (0..words.len()).filter(is_key).find_map(way);
    if let Some(way) = by_key.or_else(|| (0..words.len()).find_map(way)) {
        return Some(Polarity::Way(way));
    }
    is_unclear(&words).then_some(Polarity::Unclear)
}

/// The way that words tell which follow a key, past directions that are horizontal; the other one where it is `turned`.
fn beside<'a>(
    words: impl Iterator<Item = &'a (&'a str, Word)>,
    mut turned: bool,
) -> Option<Component> {
    for (_, word) in words {
        match word {
            Word::Way(way) => return Some(if turned { opposite(*way) } else { *way }),
            Word::Not => turned = !turned,
            Word::Horizontal | Word::Vertical => {}
            Word::Key(_) | Word::Points | Word::Other => return None,
        }
    }
    None
}

/// True of words that speak of a sign of which nothing was found.
fn is_unclear(words: &[(&str, Word)]) -> bool {
    let has = |of: &[&str]| words.iter().any(|(text, _)| of.contains(text));
    let turned = has(&["reversed", "inverted", "flipped", "upside", "opposite"]);
    let of_sign = has(&["sign", "signs", "component", "sensor", "channel"]);
    let is_vertical = words.iter().any(|(_, kind)| *kind == Word::Vertical);
    let is_normal = has(&["normal", "standard"]) && !turned;
    let of_horizontal = |pair: &[(&str, Word)]| match pair {
        [(_, Word::Key(_)), (_, other)] | [(_, other), (_, Word::Key(_))] => {
            *other == Word::Horizontal
        }
        _ => false,
    };
    let signed = words.iter().any(|(_, kind)| matches!(kind, Word::Key(true)))
        && !words.windows(2).any(of_horizontal);
    signed && !has(&SIZE) && !is_normal || turned && (of_sign || is_vertical)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Component::{Down, Up};

    #[test]
    fn words_tell_which_way_is_positive() {
        for (words, wanted) in [
            ("polarity: down", Down),
            ("Polarity = DOWN", Down),
            ("Vertical acceleration, positive-downwards", Down),
            ("UD (down positive)", Down),
            ("sign: positive = down", Down),
            ("positive direction is down", Down),
            ("acc (+ down)", Down),
            ("+ve down", Down),
            ("polarity: up", Up),
            ("up is positive", Up),
            ("positive north, east, down", Down),
            ("positive: N, E and up", Up),
            ("North, east and down are positive", Down),
            ("Z axis points down", Down),
            ("x axis points north, z axis points down", Down),
            ("the z-axis is pointing upwards", Up),
            ("Vertical (down)", Down),
            ("Time (s), Vertical (down) (m/s2)", Down),
            ("Vertical - Down", Down),
            ("component: Z down", Down),
            ("UD (up)", Up),
            ("not positive down", Up),
            ("positive is not up", Down),
            ("down is not positive", Up),
            ("not corrected, positive down", Down),
            ("negative up", Down),
            ("-ve down", Up),
            ("positive vertical: down", Down),
        ] {
            assert_eq!(stated(words), Some(Polarity::Way(wanted)), "{words}");
        }
    }

    #[test]
    fn words_of_a_sign_that_say_no_way_are_not_passed_over() {
        for words in [
            "polarity: reversed",
            "vertical component reversed",
            "positive: see the manual",
            "sensor was mounted upside down",
            "sign convention of SEED",
            "UD inverted",
        ] {
            assert_eq!(stated(words), Some(Polarity::Unclear), "{words}");
        }
        for words in [
            "scaled up by +0.5",
            "DOWN",
            "down the hill",
            "peak positive value: 3.2",
            "positive north",
            "polarity: normal",
            "Vertical, down-sampled to 100 Hz",
            "Z: 4000 points up to 40 s",
            "Up-Down (m/s2)",
            "vertical up-down",
            "borehole (down)",
            "the trace is not reversed in time",
            "units: m/s2",
        ] {
            assert_eq!(stated(words), None, "{words}");
        }
    }
}
