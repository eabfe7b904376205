//! Which way a motion is positive by the words above plain numbers, and what they say of a sign besides.

use super::super::Component;
use super::pieces::{dashes, listed};
use super::sign_words::{Word, words};
use super::ways::{OF_NAMES, Polarity, towards, way};

/// Words beside `positive` that speak of a size.
const SIZE: &str = "peak max min maximum minimum largest pga";

/// Words beside which one of a reversal is that of the accelerations.
const OF_SIGN: &str = "\
    sign signs sense component components sensor sensors channel channels record data trace acceleration \
    accelerations";

/// What the words of a line state: `positive north, east, down`, `polarity: up`, `(+ down)`, `Z axis points down`,
/// `Vertical (down)`, `not positive down`, `up positive, down negative`. A way is stated where all that the line says of it
/// agrees; else it is unclear.
pub(super) fn stated(line: &str) -> Option<Polarity> {
    let words = words(line);
    match way(line, &words) {
        Some(Polarity::Unclear) | None if is_unclear(line, &words) => Some(Polarity::Unclear),
        stated => stated,
    }
}

/// What of the name of a column is left when its direction, `component`, is known: a sign, a way or a reversal that the
/// direction does not account for. The units are no part of the name.
pub(super) fn is_left(name: &str, component: Option<Component>) -> bool {
    let words = words(name);
    let stated = way(name, &words);
    let is_known = match stated {
        Some(Polarity::Way(way)) => component.is_none_or(|own| own == way),
        Some(Polarity::OfAll(way)) => component.is_none_or(|own| own == way || !own.is_vertical()),
        _ => false,
    };
    let of_ground = !towards(name).is_empty();
    let has = |letter: &str| words.iter().any(|(text, _)| text == letter);
    words.iter().any(|(_, one)| match *one {
        Word::Reversed => true,
        Word::Key(_) | Word::Minus => !is_known && !of_ground,
        // What is not known to be down is taken as it would be up.
        Word::Way(way) => !is_known && way != component.unwrap_or(Component::Up),
        _ => false,
    }) || words.iter().any(|(text, _)| listed("sign dip", text))
        || component == Some(Component::Up) && has("d") && !has("u")
}

/// True of a text that says in words where something points, which the name of a column does not.
pub(super) fn is_sentence(text: &str) -> bool {
    let says = |one: &Word| matches!(one, Word::Key(_) | Word::Points);
    words(text).iter().any(|(_, one)| says(one))
}

/// True of a line and its words that speak of a sign, of which a way may not be found.
fn is_unclear(line: &str, words: &[(String, Word)]) -> bool {
    let has = |of: &str| words.iter().any(|(text, _)| listed(of, text));
    let any = |is: fn(Word) -> bool| words.iter().any(|(_, kind)| is(*kind));
    let is_vertical = any(|kind| kind == Word::Vertical);
    let is_axis = is_vertical || any(|kind| kind == Word::Axis);
    let has_way = any(Word::is_way);
    let of_sign = has("sign signs");
    let denied =
        |at: usize| at > 0 && words[..at].iter().rev().take(2).any(|(_, one)| *one == Word::Not);
    let is_reversal = |(at, (text, one)): (usize, &(String, Word))| {
        *one == Word::Reversed && !denied(at) && (is_vertical || of_sign || !listed(OF_NAMES, text))
    };
    let turned = words.iter().enumerate().any(is_reversal);
    // `polarity: positive`, `sign: normal`.
    let spoken: Vec<(String, Word)> =
        words.iter().filter(|(_, one)| *one != Word::Filling).cloned().collect();
    let is_plain = |(text, one): &(String, Word)| {
        matches!(one, Word::Key(true) | Word::Plus) || listed("sign signs", text)
    };
    let speaks = spoken.len() > 1;
    let is_normal = (has("normal standard") || speaks && spoken.iter().all(is_plain)) && !turned;
    let of_horizontal = |pair: &[(String, Word)]| {
        pair.iter().any(|(_, one)| matches!(one, Word::Key(_)))
            && pair.iter().any(|(_, one)| one.is_horizontal())
    };
    let is_ground = |pair: &[(String, Word)]| match pair {
        [(_, Word::Points), (text, _)] => listed("ground earth gravity", text),
        [(one, _), (other, _)] => one == "upside" && other == "down",
        _ => false,
    };
    // The dip of SEED is 90 degrees of an axis that points down.
    let of_dip = words.first().is_some_and(|(text, _)| text == "dip");
    let positive = any(|kind| kind == Word::Key(true));
    let negative = any(|kind| matches!(kind, Word::Minus | Word::Key(false)));
    let tight = line.replace(' ', "");
    let tight = dashes(&tight);
    let of_minus_one = ["=-1", ":-1"].iter().any(|one| tight.contains(one));
    let of_one = of_minus_one || tight.contains("=+1");
    let has_sign = positive || any(|kind| kind == Word::Plus) || negative || of_one || of_sign;
    positive && !words.windows(2).any(of_horizontal) && !has(SIZE) && !is_normal
        || turned && (has(OF_SIGN) || is_axis || !speaks)
        || has_way && (has_sign || is_vertical || has("axis"))
        || negative && (is_axis || of_sign || has("sense"))
        || of_sign && of_minus_one
        || spoken.windows(2).any(is_ground)
        || of_dip && tight.contains("90") && !tight.contains("-90")
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
