//! Text of pictures: symbols with indices, its width, its lines.

use std::sync::LazyLock;

use super::{FONT, SMALLEST, font};
use crate::colours::{BLACK, Colour};
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
pub(super) const DOTS: char = '\u{308}';
const DIAERESIS: char = '¨';

/// A piece of a text, which no line ends within.
pub enum Piece<'a> {
    /// A letter on the line.
    Plain(char),
    /// A symbol and its index, which is below the line.
    Symbol(&'a str, &'a str),
    /// Above the line.
    Power(&'a str),
}

/// The pieces of a text, each with what stands for it there: a symbol's index is lowered, what stands in `^{...}` is raised.
pub fn pieces(text: &str) -> Vec<(&str, Piece<'_>)> {
    let mut pieces = Vec::new();
    let mut before = ' ';
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let begins = !before.is_alphanumeric() && before != '_';
        let symbol = || {
            SYMBOLS.iter().find_map(|(letter, index)| {
                let after = rest.strip_prefix(letter)?.strip_prefix('_')?.strip_prefix(index)?;
                let ends = !after
                    .starts_with(|c: char| c.is_alphabetic() || c.is_ascii_digit() || c == '_');
                ends.then_some((Piece::Symbol(letter, index), after, 'x'))
            })
        };
        let power = || {
            let (power, after) = rest.strip_prefix("^{")?.split_once('}')?;
            Some((Piece::Power(power), after, '}'))
        };
        let found = power().or_else(|| if begins { symbol() } else { None });
        let (piece, after, last) =
            found.unwrap_or((Piece::Plain(first), &rest[first.len_utf8()..], first));
        pieces.push((&rest[..rest.len() - after.len()], piece));
        (rest, before) = (after, last);
    }
    pieces
}

/// The letters of a symbol, and whether two dots stand above it: the sign of a second derivative, which the font has for a u
/// but not for a v.
fn dotted(letter: &str) -> (&str, bool) {
    letter.strip_suffix(DOTS).map_or((letter, false), |plain| (plain, true))
}

/// The size of an index in text of a size.
fn index_size(size: f64) -> f64 {
    (size * SMALLEST / FONT).max(SMALLEST)
}

/// A character as it is drawn: a space that no line ends at is a space; characters that XML does not know are left out, and
/// those that nobody sees.
fn shown(character: char) -> Option<char> {
    match character {
        '\u{a0}' | '\t' | '\n' | '\r' => Some(' '),
        c if is_hidden(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => None,
        c => Some(c),
    }
}

/// Letters in succession of one size, and where they stand.
pub(super) struct Run {
    pub text: String,
    pub size: f64,
    pub stand: Stand,
}

/// Where letters stand.
#[derive(PartialEq)]
pub(super) enum Stand {
    /// On the line, behind those before them.
    Line,
    /// So many points further back.
    Back(f64),
    /// Below the line, as an index.
    Below,
    /// Above it, as a power.
    Above,
}

/// A text as it is drawn, indices lowered.
pub(super) fn runs(text: &str, size: f64) -> Vec<Run> {
    fn push(runs: &mut Vec<Run>, letters: impl Iterator<Item = char>, size: f64, stand: Stand) {
        let text = letters.filter_map(shown);
        match runs.last_mut() {
            Some(last) if last.stand == stand && stand == Stand::Line => last.text.extend(text),
            _ => runs.push(Run { text: text.collect(), size, stand }),
        }
    }
    let mut runs = Vec::new();
    for (_, piece) in pieces(text) {
        let (stand, raised) = match piece {
            Piece::Plain(character) => {
                push(&mut runs, std::iter::once(character), size, Stand::Line);
                continue;
            }
            Piece::Symbol(letter, index) => {
                let (plain, has_dots) = dotted(letter);
                push(&mut runs, plain.chars(), size, Stand::Line);
                if has_dots {
                    let wide = |text: &str| text.chars().map(font::advance).sum::<f64>();
                    let back = 0.5 * size * (wide(plain) + font::advance(DIAERESIS));
                    push(&mut runs, std::iter::once(DIAERESIS), size, Stand::Back(back));
                }
                (Stand::Below, index)
            }
            Piece::Power(power) => (Stand::Above, power),
        };
        push(&mut runs, raised.chars(), index_size(size), stand);
    }
    runs
}

/// A text as SVG, indices lowered.
pub fn marked_up(text: &str, size: f64) -> String {
    let mut marked = String::new();
    for Run { text, size, stand } in runs(text, size) {
        let shift = match stand {
            Stand::Line => String::new(),
            Stand::Back(back) => format!("<tspan dx=\"-{back:.2}\">"),
            Stand::Below => format!("<tspan baseline-shift=\"sub\" font-size=\"{size:.2}\">"),
            Stand::Above => format!("<tspan baseline-shift=\"super\" font-size=\"{size:.2}\">"),
        };
        marked += &shift;
        for character in text.chars() {
            match character {
                '&' => marked.push_str("&amp;"),
                '<' => marked.push_str("&lt;"),
                '>' => marked.push_str("&gt;"),
                '"' => marked.push_str("&quot;"),
                '\'' => marked.push_str("&apos;"),
                c => marked.push(c),
            }
        }
        if !shift.is_empty() {
            marked.push_str("</tspan>");
        }
    }
    marked
}

/// The pieces of a text of a size as they stand in it, each with its width, points; of a letter of size 1 `advance` is asked, once
/// for each letter.
fn measured(text: &str, size: f64, mut advance: impl FnMut(char) -> f64) -> Vec<(&str, f64)> {
    let mut of = |text: &str, size: f64| size * text.chars().map(&mut advance).sum::<f64>();
    let mut width = |from: &str, piece: Piece| match piece {
        Piece::Plain(_) => of(from, size),
        Piece::Symbol(letter, index) => of(dotted(letter).0, size) + of(index, index_size(size)),
        Piece::Power(power) => of(power, index_size(size)),
    };
    pieces(text).into_iter().map(|(from, piece)| (from, width(from, piece))).collect()
}

/// Width of a text of a size, points.
pub fn width(text: &str, size: f64) -> f64 {
    measured(text, size, font::advance).iter().map(|(_, width)| width).sum()
}

/// The lines of a text that are no wider than some points. They end at spaces; a word that is wider than a
/// line is cut.
pub fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    wrapped_by(text, size, most, font::advance)
}

/// [`wrapped`] where a letter of size 1 is as wide as `advance` says.
pub fn wrapped_by(
    text: &str,
    size: f64,
    most: f64,
    advance: impl FnMut(char) -> f64,
) -> Vec<String> {
    let pieces = measured(text, size, advance);
    let mut lines = Vec::new();
    let (mut line, mut wide) = (String::new(), 0.0);
    // The width of the space before a word.
    let mut space = 0.0;
    for word in pieces.split_inclusive(|(from, _)| *from == " ") {
        let (word, after) = match word {
            [word @ .., (" ", after)] => (word, *after),
            word => (word, 0.0),
        };
        let own: f64 = word.iter().map(|(_, width)| width).sum();
        if !line.is_empty() && wide + space + own > most {
            lines.push(std::mem::take(&mut line));
            wide = 0.0;
        } else if !line.is_empty() {
            line.push(' ');
            wide += space;
        }
        for (from, width) in word {
            if wide + width > most && !line.is_empty() {
                lines.push(std::mem::take(&mut line));
                wide = 0.0;
            }
            line.push_str(from);
            wide += width;
        }
        space = after;
    }
    lines.push(line);
    lines
}

/// A text, its middle left out where it is wider than some points.
pub fn shortened(text: &str, size: f64, most: f64) -> String {
    shortened_by(text, size, most, font::advance)
}

/// What stands for the middle of a text that is left out.
const LEFT_OUT: &str = " … ";

/// [`shortened`] where a letter of size 1 is as wide as `advance` says.
pub fn shortened_by(
    text: &str,
    size: f64,
    most: f64,
    mut advance: impl FnMut(char) -> f64,
) -> String {
    let pieces = measured(text, size, &mut advance);
    let widths = |from: &[(&str, f64)]| from.iter().map(|(_, width)| width).sum::<f64>();
    if widths(&pieces) <= most {
        return text.to_string();
    }
    let room = most - widths(&measured(LEFT_OUT, size, advance));
    // Pieces are kept at both ends by turns, as long as they fit.
    let (mut head, mut tail, mut wide) = (0, pieces.len(), 0.0);
    while head < tail {
        let at_head = head <= pieces.len() - tail;
        let next = if at_head { head } else { tail - 1 };
        wide += pieces[next].1;
        if wide > room {
            break;
        }
        if at_head { head += 1 } else { tail -= 1 }
    }
    let text = |from: &[(&str, f64)]| from.iter().map(|(from, _)| *from).collect::<String>();
    match (head, room < 0.0) {
        (0, _) | (_, true) => "…".into(),
        _ => {
            let (head, tail) = (text(&pieces[..head]), text(&pieces[tail..]));
            format!("{}{LEFT_OUT}{}", head.trim_end(), tail.trim_start())
        }
    }
}
