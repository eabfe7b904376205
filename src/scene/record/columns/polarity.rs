//! Which way a vertical is positive, by the words above plain numbers.

use super::super::Component;

/// What words state of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Polarity {
    Way(Component),
    /// The same of a recorder, of whose horizontal components they speak too: a file beside them may be any of the three.
    OfAll(Component),
    /// They speak of a sign, and not in words that are known.
    Unclear,
}

/// Words that change nothing between a key and its way.
const FILLING: [&str; 21] = [
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
    "t",
    "longer",
    "it",
];

const NOT: [&str; 7] = ["not", "no", "isn", "aren", "wasn", "never", "false"];

/// Words of a line whose way is not that of its accelerations now.
const OF_OTHERS: [&str; 12] = [
    "depth",
    "depths",
    "elevation",
    "location",
    "position",
    "coordinate",
    "coordinates",
    "original",
    "originally",
    "was",
    "were",
    "rotated",
];

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
    /// What has a sign: true where the way beside it is the positive one.
    Key(bool),
    /// The sign `-` by itself. It may be a dash.
    Minus,
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
        "positive" | "pos" | "plus" | "polarity" | "convention" => Word::Key(true),
        MINUS => Word::Minus,
        "negative" | "neg" | "minus" => Word::Key(false),
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

/// What a `-` is spelled as that may be a sign.
const MINUS: &str = "minussign";

/// A line in lower case whose signs before or behind words are words: `+ down`, `+ve`, `(-)`, ` -down`.
fn spelled(line: &str) -> String {
    let lower = line.to_lowercase().replace("-ve ", " negative ");
    let mut plain = String::with_capacity(lower.len());
    let mut before = ' ';
    for (at, c) in lower.char_indices() {
        let next = lower[at + c.len_utf8()..].chars().next();
        let after = lower[at + c.len_utf8()..].trim_start().chars().next();
        let apart = |c: char| c.is_whitespace() || "()[],;:=/".contains(c);
        let is_minus = c == '-'
            && apart(before)
            && (next.is_some_and(char::is_alphabetic)
                || after.is_none_or(|c| "()[],;/".contains(c)));
        if c == '+' && !after.is_some_and(|c| c.is_ascii_digit() || c == '.') {
            plain.push_str(" positive ");
        } else if is_minus {
            plain.extend([" ", MINUS, " "]);
        } else {
            plain.push(c);
        }
        before = c;
    }
    plain
}

/// What the words of a line state: `positive north, east, down`, `polarity: up`, `(+ down)`, `Z axis points down`,
/// `Vertical (down)`, `not positive down`, `up positive, down negative`. A way is stated where all that the line says of it
/// agrees; else it is unclear.
pub(super) fn stated(line: &str) -> Option<Polarity> {
    let line = spelled(line);
    let words = split(&line);
    let of_axis = line.contains("axis") || words.iter().any(|(_, one)| *one == Word::Vertical);
    let mut ways = Vec::new();
    let mut unclear = is_unclear(&line, &words);
    // What stands between other words is read by itself.
    for part in words.split(|(_, kind)| *kind == Word::Other) {
        match of_part(part, of_axis) {
            Some(Polarity::Way(way)) => ways.push(way),
            Some(_) => unclear = true,
            None => {}
        }
    }
    let [way, others @ ..] = &ways[..] else {
        return unclear.then_some(Polarity::Unclear);
    };
    let of_others = words.iter().any(|(text, _)| OF_OTHERS.contains(text));
    let answered = line.trim_end().strip_suffix('0').map(str::trim_end);
    let denied = answered.is_some_and(|line| line.ends_with([':', '=']))
        || matches!(words.last(), Some((_, Word::Not)));
    let agree = others.iter().all(|other| other == way);
    let of_all = words.iter().any(|(_, one)| *one == Word::Horizontal);
    Some(match agree && !of_others && !denied {
        true if of_all => Polarity::OfAll(*way),
        true => Polarity::Way(*way),
        false => Polarity::Unclear,
    })
}

/// True of a text that says in words where something points, which the name of a column does not.
pub(super) fn is_sentence(text: &str) -> bool {
    split(&text.to_lowercase()).iter().any(|(_, one)| matches!(one, Word::Key(_) | Word::Points))
}

/// A key and the way that it has; true where the key is no lone `-`.
type Pair = (Component, bool);

/// What words state that follow each other.
fn of_part(words: &[(&str, Word)], of_axis: bool) -> Option<Polarity> {
    let mut turned = false;
    let mut items: Vec<Word> = Vec::new();
    for (_, kind) in words {
        match *kind {
            Word::Not => turned = !turned,
            Word::Way(way) => {
                let way = if std::mem::take(&mut turned) { opposite(way) } else { way };
                if items.last() != Some(&Word::Way(way)) {
                    items.push(Word::Way(way));
                }
            }
            Word::Key(positive) => {
                let key = Word::Key(positive != std::mem::take(&mut turned));
                if items.last() != Some(&key) {
                    items.push(key);
                }
            }
            Word::Minus | Word::Points => items.push(*kind),
            // An axis that points there is another one.
            Word::Horizontal if items.last() == Some(&Word::Points) => {
                items.pop();
            }
            Word::Vertical | Word::Horizontal | Word::Other => {}
        }
    }
    let has_key = items.iter().any(|item| matches!(item, Word::Key(_) | Word::Minus));
    let has_way = items.iter().any(|item| matches!(item, Word::Way(_)));
    if has_key && has_way {
        let pairs: Option<Vec<Pair>> = items.chunks(2).map(pair).collect();
        let Some(pairs) = pairs.filter(|_| !turned) else { return Some(Polarity::Unclear) };
        let told = pairs.iter().any(|(_, sure)| *sure);
        let way = pairs.first().map(|(way, _)| *way)?;
        let agree = pairs.iter().all(|(other, _)| *other == way);
        return Some(if agree && told { Polarity::Way(way) } else { Polarity::Unclear });
    }
    match items[..] {
        [Word::Points, Word::Way(way)] if of_axis => Some(Polarity::Way(way)),
        [Word::Way(way)] => {
            let beside =
                |pair: &[(&str, Word)]| matches!(pair, [(_, Word::Vertical), (_, Word::Way(_))]);
            words.windows(2).any(beside).then_some(Polarity::Way(way))
        }
        _ => None,
    }
}

/// The positive way that a key and a way tell, in either order.
fn pair(items: &[Word]) -> Option<Pair> {
    let ((Word::Way(way), key) | (key, Word::Way(way))) = (*items.first()?, *items.get(1)?) else {
        return None;
    };
    match key {
        Word::Key(positive) => Some((if positive { way } else { opposite(way) }, true)),
        Word::Minus => Some((opposite(way), false)),
        _ => None,
    }
}

/// True of a line and its words that speak of a sign, of which a way may not be found.
fn is_unclear(line: &str, words: &[(&str, Word)]) -> bool {
    let has = |of: &[&str]| words.iter().any(|(text, _)| of.contains(text));
    let turned = has(&["reversed", "inverted", "flipped", "upside", "opposite"]);
    let of_sign = has(&["sign", "signs", "component", "sensor", "channel"]);
    let any = |is: fn(&Word) -> bool| words.iter().any(|(_, kind)| is(kind));
    let is_vertical = any(|kind| *kind == Word::Vertical);
    let is_normal = has(&["normal", "standard"]) && !turned;
    let of_horizontal = |pair: &[(&str, Word)]| match pair {
        [(_, Word::Key(_)), (_, other)] | [(_, other), (_, Word::Key(_))] => {
            *other == Word::Horizontal
        }
        _ => false,
    };
    let positive = any(|kind| *kind == Word::Key(true));
    let negative = any(|kind| matches!(kind, Word::Minus | Word::Key(false)));
    let has_way = any(|kind| matches!(kind, Word::Way(_)));
    let tight = line.replace(' ', "");
    let of_one = ["=+1", "=-1"].iter().any(|one| tight.contains(one));
    let has_sign = positive || negative || of_one || has(&["sign", "signs"]);
    positive && !words.windows(2).any(of_horizontal) && !has(&SIZE) && !is_normal
        || turned && (of_sign || is_vertical)
        || has_way && (has_sign || is_vertical)
        || negative && is_vertical
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
            ("Z axis points down", Down),
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
            ("up positive, down negative", Up),
            ("up is positive and down is negative", Up),
            ("Up (+), Down (-)", Up),
            ("+up -down", Up),
            ("UD (up + / down -)", Up),
            ("upward positive, downward negative", Up),
            ("down: positive, up: negative", Down),
            ("down is negative, up is positive", Up),
            ("negative up, positive down", Down),
            ("positive up (not down)", Up),
            ("isn't positive down", Up),
            ("no longer positive down", Up),
        ] {
            assert_eq!(stated(words), Some(Polarity::Way(wanted)), "{words}");
        }
        for (words, wanted) in [
            ("positive north, east, down", Down),
            ("positive: N, E and up", Up),
            ("North, east and down are positive", Down),
            ("x axis points north, z axis points down", Down),
        ] {
            assert_eq!(stated(words), Some(Polarity::OfAll(wanted)), "{words}");
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
            "positive down: no",
            "positive down: false",
            "positive_down = 0",
            "positive up: no",
            "was positive down, now positive up",
            "original polarity: down; data: positive up",
            "depth 20 m, positive down",
            "sensor depth (down positive): 10 m",
            "accelerations are positive when the ground moves down",
            "downward movement gives positive values",
            "Vertical 10m down",
            "vertical -down",
            "vertical component, 5 m down",
            "UD (-)",
            "-Z",
            "minus Z",
            "down=+1",
            "up = -1",
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
