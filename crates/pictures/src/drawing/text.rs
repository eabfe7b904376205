//! Text of pictures: symbols with indices, its width, its lines.

use std::sync::LazyLock;

use super::{FONT, SMALLEST, font};
use topple::results::colour::{BLACK, Colour};
use topple::scene::parameters::PARAMETERS;
use topple::scene::shown::is_hidden;

/// Which end of a text its place is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The left one.
    Start,
    /// Its middle.
    Middle,
    /// The right one.
    End,
}

/// How a text is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Size of its letters, points.
    pub size: f64,
    /// What its place is.
    pub anchor: Anchor,
    /// Written upwards, as at a vertical axis.
    pub upwards: bool,
    /// Its colour.
    pub colour: Colour,
}

/// Text of a size from its place on.
pub const fn style(size: f64) -> Style {
    Style { size, anchor: Anchor::Start, upwards: false, colour: BLACK }
}

impl Style {
    /// The same, about its place.
    pub const fn middle(self) -> Style {
        Style { anchor: Anchor::Middle, ..self }
    }

    /// The same, ending at its place.
    pub const fn end(self) -> Style {
        Style { anchor: Anchor::End, ..self }
    }

    /// The same, upwards.
    pub const fn upwards(self) -> Style {
        Style { upwards: true, ..self }
    }
}

/// From the foot of a line of text to its middle, over its size: half the height of a figure.
pub const MIDDLE: f64 = 0.35;

/// Symbols with an index: those of the parameters, and of what is not one.
static SYMBOLS: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
    let others = ["ω_v", "ω_h", "ü_g", "v\u{308}_g"];
    let all = PARAMETERS.iter().map(|entry| entry.symbol).chain(others);
    all.filter_map(|symbol| symbol.split_once('_')).collect()
});

/// Two dots above the letter before, and the same as a letter.
const DOTS: char = '\u{308}';
const DIAERESIS: char = '¨';

/// A piece of a text.
pub enum Piece<'a> {
    /// On the line.
    Plain(char),
    /// With two dots, the sign of a second derivative, which the font has for a u but not for a v.
    Dotted(char),
    /// Below it.
    Index(&'a str),
    /// Above it.
    Power(&'a str),
}

/// The pieces of a text: a symbol's index is lowered, what stands in `^{...}` is raised.
pub fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut before = ' ';
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if let Some((power, after)) = rest.strip_prefix("^{").and_then(|from| from.split_once('}'))
        {
            pieces.push(Piece::Power(power));
            (rest, before) = (after, '}');
            continue;
        }
        let begins = !before.is_alphanumeric() && before != '_';
        let symbol = SYMBOLS.iter().find_map(|(letter, index)| {
            let after = rest.strip_prefix(letter)?.strip_prefix('_')?.strip_prefix(index)?;
            let ends =
                !after.starts_with(|c: char| c.is_alphabetic() || c.is_ascii_digit() || c == '_');
            (begins && ends).then_some((*letter, *index, after))
        });
        if let Some((letter, index, after)) = symbol {
            match letter.strip_suffix(DOTS).and_then(|plain| plain.chars().next()) {
                Some(plain) => pieces.push(Piece::Dotted(plain)),
                None => pieces.extend(letter.chars().map(Piece::Plain)),
            }
            pieces.push(Piece::Index(index));
            (rest, before) = (after, 'x');
            continue;
        }
        pieces.push(Piece::Plain(first));
        before = first;
        rest = &rest[first.len_utf8()..];
    }
    pieces
}

/// The size of an index in text of a size.
fn index_size(size: f64) -> f64 {
    (size * SMALLEST / FONT).max(SMALLEST)
}

/// A character as SVG writes it. A space that no line ends at is a space; characters that XML does not know
/// are left out, and those that nobody sees.
fn push_escaped(text: &mut String, character: char) {
    match character {
        '&' => text.push_str("&amp;"),
        '<' => text.push_str("&lt;"),
        '>' => text.push_str("&gt;"),
        '"' => text.push_str("&quot;"),
        '\'' => text.push_str("&apos;"),
        '\u{a0}' | '\t' | '\n' | '\r' => text.push(' '),
        c if is_hidden(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
        c => text.push(c),
    }
}

/// A text as SVG, indices lowered.
pub fn marked_up(text: &str, size: f64) -> String {
    let mut marked = String::new();
    for piece in pieces(text) {
        let (shift, raised) = match piece {
            Piece::Plain(character) => {
                push_escaped(&mut marked, character);
                continue;
            }
            Piece::Dotted(character) => {
                push_escaped(&mut marked, character);
                let back = 0.5 * size * (font::advance(character) + font::advance(DIAERESIS));
                marked.push_str(&format!("<tspan dx=\"-{back:.2}\">{DIAERESIS}</tspan>"));
                continue;
            }
            Piece::Index(index) => ("sub", index),
            Piece::Power(power) => ("super", power),
        };
        let small = index_size(size);
        marked.push_str(&format!("<tspan baseline-shift=\"{shift}\" font-size=\"{small:.2}\">"));
        raised.chars().for_each(|character| push_escaped(&mut marked, character));
        marked.push_str("</tspan>");
    }
    marked
}

/// Width of a text of a size, points.
pub fn width(text: &str, size: f64) -> f64 {
    let of = |text: &str, size: f64| size * text.chars().map(font::advance).sum::<f64>();
    let piece = |piece: &Piece| match piece {
        Piece::Plain(character) | Piece::Dotted(character) => size * font::advance(*character),
        Piece::Index(text) | Piece::Power(text) => of(text, index_size(size)),
    };
    pieces(text).iter().map(piece).sum()
}

/// The lines of a text that are no wider than some points. They end at spaces; a word that is wider than a
/// line is cut.
pub fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split(' ') {
        let longer = if line.is_empty() { word.to_string() } else { format!("{line} {word}") };
        if width(&longer, size) <= most {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for character in word.chars() {
            line.push(character);
            if width(&line, size) > most && line.chars().count() > 1 {
                line.pop();
                lines.push(std::mem::take(&mut line));
                line.push(character);
            }
        }
    }
    lines.push(line);
    lines
}

/// A text, its middle left out where it is wider than some points.
pub fn shortened(text: &str, size: f64, most: f64) -> String {
    if width(text, size) <= most {
        return text.to_string();
    }
    let characters: Vec<char> = text.chars().collect();
    let kept = |count: usize| {
        let (head, tail) = (count.div_ceil(2), count / 2);
        let head: String = characters[..head].iter().collect();
        let tail: String = characters[characters.len() - tail..].iter().collect();
        format!("{} … {}", head.trim_end(), tail.trim_start())
    };
    let fits = (0..characters.len()).rev().map(kept).find(|text| width(text, size) <= most);
    fits.unwrap_or_else(|| "…".into())
}

#[cfg(test)]
mod tests {
    use super::{marked_up, shortened, width, wrapped};
    use crate::drawing::FONT;

    #[test]
    fn symbols_have_indices_and_names_of_files_have_none() {
        let marked = marked_up("T_h = 2 s, max |v + g/ω_v²|, AT_h.at2, T_hx", 7.0);
        let lowered = |letter: &str, index: &str| {
            format!("{letter}<tspan baseline-shift=\"sub\" font-size=\"6.00\">{index}</tspan>")
        };
        assert!(marked.starts_with(&format!("{} = 2 s", lowered("T", "h"))), "{marked}");
        assert!(marked.contains(&format!("{}²|", lowered("ω", "v"))), "{marked}");
        assert!(marked.ends_with("AT_h.at2, T_hx"), "{marked}");
        assert_eq!(
            marked_up("10^{-3}", 7.0),
            "10<tspan baseline-shift=\"super\" font-size=\"6.00\">-3</tspan>"
        );
    }

    #[test]
    fn what_xml_reserves_is_escaped_and_what_it_forbids_is_left_out() {
        let marked = marked_up("<a href='x'>\"&\u{1}\u{7}", 7.0);
        assert_eq!(marked, "&lt;a href=&apos;x&apos;&gt;&quot;&amp;");
    }

    #[test]
    fn lines_are_no_wider_than_they_may_be() {
        let text = "B = 0.175 m, H = 0.95 m, a_name_that_has_no_space_in_it_and_is_far_too_long_for_a_line";
        let lines = wrapped(text, FONT, 90.0);
        assert!(lines.len() > 3 && lines.iter().all(|line| width(line, FONT) <= 90.0), "{lines:?}");
        assert_eq!(lines.concat().replace(' ', ""), text.replace(' ', ""));
        let short = shortened(text, FONT, 90.0);
        assert!(short.contains(" … ") && short.starts_with("B = 0.1") && short.ends_with("line"));
        assert!(width(&short, FONT) <= 90.0 && width(&short, FONT) > 75.0);
        assert_eq!(shortened("short", FONT, 90.0), "short");
    }
}
