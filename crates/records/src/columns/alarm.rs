//! Words and marks above plain numbers that may change the sign or the size of the values. A text that has one and that
//! no rule has read is refused; a text without one is a title.

use super::polarity::{self, VERTICAL, Ways, words};
use super::words::{direction, in_brackets, listed, lower, tokens, without_units};
use crate::numbers::number;
use crate::{Component, Units, component};

/// How words begin that tell it anywhere.
const BEGINNINGS: &str = "\
    invert invers umgekehrt reversed reversal flipp negat positiv polarit upside mirror swapped opposite backward scal \
    skal escala factor facteur downacc downwardacc earthward multipli multiply amplif attenuat magnif divid normali";

/// Whole words that tell it anywhere.
const WHOLE: &str = "\
    sign signs pos plus neg minus flip convention gain gains increased reduced doubled tripled halved mult div \
    calibration conversion lsb unten bas ned nwd sed swd wsd esd wnd frd";

/// Whole words of a vertical that is positive down.
const DOWN: &str = "down downward downwards dwn dn";

/// Words that tell it beside an axis, and in the name of a column.
const BESIDE_AXIS: &str = "\
    reverse rev opp inv turned changed dip sense up upward upwards points pointing directed oriented";

/// Words that tell it in the name of a column.
const OF_NAMES: &str = "milli micro kilo percent thousandth thousandths hundredth hundredths";

/// What holds one of these words and is another thing.
const OTHERS: [&str; 6] = ["up-down", "up/down", "updown", "up to ", "down-sampl", "down-hole"];

/// True of a line that may change the values; `known` is the direction that is read in it.
pub(super) fn of_line(line: &str, known: Option<Component>) -> bool {
    polarity::phrase(line).is_none() && !is_normal(line) && is_in(line, known, false)
}

/// The same of the name of a column, whose direction is `component`: units and a way that agrees are no part of it.
pub(super) fn of_name(name: &str, component: Option<Component>) -> bool {
    let name = without_others(&without_units(name));
    let agrees = |ways: &Ways| match (ways.vertical, component) {
        (Some(way), Some(own)) if own.is_vertical() => way == own,
        (Some(way), own) => ways.of_all && ways.is_stated || own.is_none() && way == Component::Up,
        (None, _) => true,
    };
    if let Some(ways) = polarity::phrase(&name) {
        return !agrees(&ways);
    }
    let mut rest = name.clone();
    for text in in_brackets(&name) {
        if text.trim() == "+" || polarity::in_brackets(text).is_some_and(|ways| agrees(&ways)) {
            rest = rest.replacen(text, "", 1);
        }
    }
    // A lone d may be down, and may be a displacement.
    let has = |letter: &str| words(&rest).any(|word| word == letter);
    let is_d = component.is_none() && direction(&name) == "d";
    let of_d = component == Some(Component::Up) && has("d") && !has("u");
    // Outside of brackets up is the direction; in them another direction is a contradiction.
    let azimuth = component::azimuth(direction(&name));
    let is_other = |text: &&str| {
        let counts = text.len() < 3 && number(text).is_some();
        let other = component::azimuth(text).is_some_and(|one| Some(one) != azimuth);
        words(text).any(|word| word.starts_with("up")) || other && azimuth.is_some() && !counts
    };
    let of_bracket = in_brackets(&rest).iter().any(is_other);
    is_d || of_d || of_bracket || is_in(&rest, component, true)
}

/// True of what says that nothing is reversed: `polarity: normal`, `sign: positive`.
fn is_normal(line: &str) -> bool {
    const PLAIN: &str = "polarity sign sense positive normal standard is";
    let line = lower(line);
    line.chars().all(|c| c.is_alphabetic() || " :=".contains(c))
        && words(&line).count() > 1
        && words(&line).all(|word| listed(PLAIN, word))
}

/// A text in lower case without what holds a word and is another thing.
fn without_others(text: &str) -> String {
    OTHERS.iter().fold(lower(text), |text, other| text.replace(other, " "))
}

/// The word of a text that tells it, if one does and not a mark.
pub(super) fn word(text: &str) -> Option<String> {
    let text = without_others(&without_units(text));
    let beside = |word| [DOWN, BESIDE_AXIS, OF_NAMES].iter().any(|list| listed(list, word));
    words(&text).find(|word| tells(word) || beside(word)).map(String::from)
}

/// True of a word that tells it anywhere.
fn tells(word: &str) -> bool {
    BEGINNINGS.split_ascii_whitespace().any(|one| word.starts_with(one))
        || listed(WHOLE, word)
        || glued(word).is_some()
}

fn is_in(text: &str, known: Option<Component>, is_name: bool) -> bool {
    let mut text = without_others(&without_units(text));
    // Units have marks of products.
    let units: Vec<String> =
        tokens(&text).filter(|word| Units::named(word).is_some()).map(String::from).collect();
    for unit in units.iter().filter(|unit| unit.contains(['*', '/', '^', '-'])) {
        text = text.replace(unit.as_str(), " ");
    }
    let has = |list: &str| words(&text).any(|word| listed(list, word));
    let of_axis = is_name || has(VERTICAL) || has("axis ns ew");
    let of_sign = of_axis || has("up") || known.is_some_and(Component::is_vertical);
    let is_up = known == Some(Component::Up) && is_name;
    // Letters of three ways, of which d is down; END is no word beside axes.
    let of_three = has("n s") && has("e w") || has(VERTICAL) || has("components component");
    let of_system = has("axes frame system coordinates components channels order orientation");
    let is_d = has("d") && of_three || has("end") && of_system;
    let beside_axis = |word: &str| listed(BESIDE_AXIS, word) && !(is_up && word.starts_with("up"));
    words(&text).any(tells)
        || known != Some(Component::Down) && (is_d || has(DOWN))
        || of_axis && words(&text).any(beside_axis)
        || words(&text).next() == Some("dip")
        || has("points pointing directed") && has("ground earth gravity")
        || is_name && has(OF_NAMES)
        || is_product(&shape(&text), of_sign, is_name)
}

/// A vertical that is one word with its sign: `Zneg`, `invUD`, `Zdown`.
pub(super) fn glued(word: &str) -> Option<&str> {
    ["neg", "inv", "rev", "flip", "down", "dn", "up"].iter().find_map(|sign| {
        let vertical = word.strip_suffix(sign).or(word.strip_prefix(sign))?;
        listed("z ud hnz hlz bnz vert", vertical).then_some(vertical)
    })
}

/// A text with a letter for each word and a digit for each number: x of `x` and `times`, f of `sf`, u of up, a of others; 2
/// of a whole number below ten, 0 of a part below a tenth, 1 of others.
fn shape(text: &str) -> String {
    let mut shape = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = |part: &dyn Fn(char) -> bool| rest.find(|c| !part(c)).unwrap_or(rest.len());
        let is_point = first == '.' && !shape.ends_with('a');
        let (piece, letter) = if first.is_alphabetic() {
            let word = &rest[..end(&char::is_alphabetic)];
            let letter = match word {
                "x" | "times" => 'x',
                "sf" => 'f',
                "up" => 'u',
                _ => 'a',
            };
            (word, letter)
        } else if first.is_ascii_digit()
            || is_point && rest[1..].starts_with(|c: char| c.is_ascii_digit())
        {
            let mut length = end(&|c| c.is_ascii_digit() || c == '.');
            let behind = rest[length..].strip_prefix('e').unwrap_or_default();
            let digits = behind.strip_prefix(['+', '-']).unwrap_or(behind);
            let count = digits.bytes().take_while(u8::is_ascii_digit).count();
            if count > 0 && !digits[count..].starts_with(char::is_alphabetic) {
                length += 1 + behind.len() - digits.len() + count;
            }
            let letter = match rest[..length].parse::<f64>() {
                Ok(number) if number < 10.0 && number.fract() == 0.0 => '2',
                Ok(number) if number < 0.1 => '0',
                _ => '1',
            };
            (&rest[..length], letter)
        } else if first == '-' {
            // A rule of dashes is no sign.
            let dashes = &rest[..end(&|c| c == '-')];
            (dashes, if dashes.len() == 1 { '-' } else { ' ' })
        } else {
            let letter = match first {
                '[' => '(',
                ']' => ')',
                c if c.is_whitespace() => ' ',
                c => c,
            };
            (&rest[..first.len_utf8()], letter)
        };
        shape.push(letter);
        rest = &rest[piece.len()..];
    }
    shape
}

/// True of a shape with a product, a division, or a sign.
fn is_product(shape: &str, of_sign: bool, is_name: bool) -> bool {
    let tight = shape.replace(' ', "");
    let bare = tight.replace(['(', ')'], "");
    let has = |patterns: &[&str]| patterns.iter().any(|one| bare.contains(one));
    // A letter and its number are the name of a channel: X1.
    let times = has(&["x1", "x0", "x-"]) || tight.contains("(x2") || shape.contains(" x 2");
    has(&["*", "1x", "0x", "\u{d7}", "\u{f7}", "a/1", "a/0", "f=", "f:", "f1", "f2", "f0"])
        || has(&["+a", "+u", "u=-", "u=+", "u:-", "u:+"])
        || times
        || of_sign && has_sign(shape, is_name)
        || is_name && has(&["^", "2x", "a/2", "2/1", "2:1", "2:0", "0"])
}

/// True of a shape with a `-` that is a sign: before a word, or a number where those count, and apart from what stands
/// before; or first, or behind all of a bracket.
fn has_sign(shape: &str, of_numbers: bool) -> bool {
    shape.match_indices('-').any(|(at, _)| {
        let (before, behind) = (&shape[..at], &shape[at + 1..]);
        let touches = before.ends_with(|c: char| c.is_alphanumeric() || ".)".contains(c));
        let ends = behind.trim_start().chars().next().is_none_or(|c| "(),;/".contains(c));
        match behind.chars().next() {
            Some('0'..='9') => of_numbers && !touches,
            Some(c) if c.is_alphabetic() || c == '(' => !touches,
            _ => before.trim_start().is_empty() || before.ends_with('(') || ends,
        }
    })
}
