//! The words of a line that speak of a sign, or of what has one.

use super::super::Component;
use super::pieces::{Piece, listed, pieces};

/// What a word of a line is to its sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Word {
    /// Up or down.
    Way(Component),
    /// What has a sign: true where the way beside it is the positive one.
    Key(bool),
    /// The sign `+` by itself.
    Plus,
    /// The sign `-` by itself. It may be a dash.
    Minus,
    /// What says that a sign was changed.
    Reversed,
    /// An axis that points somewhere.
    Points,
    Vertical,
    /// A horizontal axis, such as `ns`.
    Axis,
    /// A way along the ground, degrees from north over east; none of one beside the axes of the earth.
    Toward(Option<f64>),
    Not,
    /// A word that changes nothing between a key and its way.
    Filling,
    Other,
}

const FILLING: &str = "\
    is are axis direction dir motion motions values acceleration accelerations for of the ve means sense and to t \
    longer it toward towards into";

const NOT: &str = "not no isn aren wasn never false";

/// What is vertical, without its sign.
const VERTICAL: &str = "vertical vert ver z ud hnz hlz bnz";

const REVERSED: &str = "\
    reversed inverted inverse invert inverts flipped flip upside opposite mirrored negated swapped backward \
    backwards invertido invertida invertito inversé umgekehrt inv rev reverse opp reversal turned changed";

fn word(word: &str) -> Word {
    let toward = |degrees: f64| Word::Toward(Some(degrees));
    match word {
        "down" | "downward" | "downwards" | "dwn" | "dn" => Word::Way(Component::Down),
        "up" | "upward" | "upwards" => Word::Way(Component::Up),
        "positive" | "pos" | "plus" | "polarity" | "convention" => Word::Key(true),
        "negative" | "neg" | "minus" | "negativ" | "negativo" | "negativa" => Word::Key(false),
        "points" | "pointing" | "directed" | "oriented" => Word::Points,
        "north" | "northward" | "northwards" | "n" => toward(0.0),
        "east" | "eastward" | "eastwards" | "e" => toward(90.0),
        "south" | "southward" | "southwards" => toward(180.0),
        "west" | "westward" | "westwards" | "w" => toward(270.0),
        "right" | "left" | "forward" => Word::Toward(None),
        "ns" | "ew" | "radial" | "tangential" | "transverse" => Word::Axis,
        _ if listed(VERTICAL, word) => Word::Vertical,
        _ if listed(NOT, word) => Word::Not,
        _ if listed(FILLING, word) => Word::Filling,
        _ if listed(REVERSED, word) => Word::Reversed,
        _ => Word::Other,
    }
}

impl Word {
    pub fn is_toward(self) -> bool {
        matches!(self, Word::Toward(_))
    }

    pub fn is_horizontal(self) -> bool {
        self.is_toward() || self == Word::Axis
    }

    pub fn is_way(self) -> bool {
        matches!(self, Word::Way(_))
    }
}

/// The words of a line, each with its text: `+ down` is positive down; `up-down` is no way, and neither is `down-sampled`.
pub(super) fn words(line: &str) -> Vec<(String, Word)> {
    let (pieces, touching): (Vec<Piece>, Vec<bool>) = pieces(line).into_iter().unzip();
    let is_number = |at: usize| matches!(pieces.get(at), Some(Piece::Number(_)));
    let mut found: Vec<(String, Word)> = Vec::new();
    let mut at = 0;
    while at < pieces.len() {
        let next = pieces.get(at + 1);
        let way = |piece: Option<&Piece>| match piece {
            Some(Piece::Word(text)) => Some(word(text)).filter(|one| one.is_way()),
            _ => None,
        };
        let number = is_number(at + 1);
        let stated = matches!(next, Some(Piece::Other(':' | '=')));
        let plus = |at: Option<usize>| at.and_then(|at| pieces.get(at)) == Some(&Piece::Plus);
        match &pieces[at] {
            Piece::Minus if !number => {
                let key = matches!(next, Some(Piece::Word(text)) if text == "ve");
                found.push(("-".into(), if key { Word::Key(false) } else { Word::Minus }));
            }
            Piece::Word(text) if text == "sense" && stated => {
                found.push((text.clone(), Word::Key(true)));
            }
            Piece::Word(text) if text == "s" && (plus(at.checked_sub(1)) || plus(Some(at + 1))) => {
                found.push((text.clone(), Word::Toward(Some(180.0))));
            }
            // The letters of a bearing are no ways: N17E.
            Piece::Word(text) if word(text).is_toward() && number && touching[at + 1] => {
                found.push((text.clone(), Word::Axis));
            }
            Piece::Word(text)
                if word(text).is_toward() && touching[at] && is_number(at.wrapping_sub(1)) => {}
            Piece::Plus if !number => found.push(("+".into(), Word::Plus)),
            Piece::Word(text) => {
                let apart = matches!(next, Some(Piece::Hyphen | Piece::Over));
                let behind = pieces.get(at + 1 + usize::from(apart));
                let other = way(behind).filter(|other| word(text).is_way() && *other != word(text));
                let no_way = ["sampled", "sampling", "hole", "to"];
                let none = matches!(behind, Some(Piece::Word(text)) if no_way.contains(&&**text));
                found.push(match other {
                    // `down-up` is the axis from up to down, and down its positive way.
                    Some(_) if apart && word(text) == Word::Way(Component::Down) => {
                        (text.clone(), word(text))
                    }
                    Some(_) => (text.clone(), Word::Vertical),
                    None if none && word(text).is_way() => (text.clone(), Word::Other),
                    None => (text.clone(), word(text)),
                });
                if let Some((vertical, sign)) = glued(text) {
                    found.pop();
                    found.extend([(vertical.to_string(), Word::Vertical), (text.clone(), sign)]);
                }
                at += if other.is_some() { 1 + usize::from(apart) } else { 0 };
            }
            _ => {}
        }
        at += 1;
    }
    name_letters(&mut found);
    name_system(&mut found);
    found
}

/// The vertical and its sign in one word: `Zneg`, `invUD`, `Zdown`.
pub(super) fn glued(text: &str) -> Option<(&str, Word)> {
    ["neg", "inv", "rev", "flip", "down", "dn", "up"].iter().find_map(|sign| {
        let vertical = text.strip_suffix(sign).or(text.strip_prefix(sign))?;
        listed("z ud hnz hlz bnz vert", vertical).then(|| (vertical, word(sign)))
    })
}

/// Letters that are ways beside north and east: `N, E, D`; without them an s may be a second, and a d anything.
fn name_letters(words: &mut [(String, Word)]) {
    let has = |degrees: f64| words.iter().any(|(_, one)| *one == Word::Toward(Some(degrees)));
    let along = [0.0, 180.0].map(has).contains(&true) || words.iter().any(|(text, _)| text == "s");
    let across = [90.0, 270.0].map(has).contains(&true);
    for (text, one) in words {
        match text.as_str() {
            "d" if along && across => *one = Word::Way(Component::Down),
            "u" if along && across => *one = Word::Way(Component::Up),
            "s" if across => *one = Word::Toward(Some(180.0)),
            _ => {}
        }
    }
}

/// A system of axes that is called by their letters: `axes: NED`.
fn name_system(words: &mut Vec<(String, Word)>) {
    const BESIDE: &str = "\
        channel axes axis system frame components component channels order orientation convention directions reference";
    let alone = words.iter().all(|(text, one)| {
        text == "ned"
            || *one == Word::Filling
            || listed(BESIDE, text)
            || text.starts_with("coordinate")
    });
    if alone && words.iter().any(|(text, _)| text == "ned") {
        let letters = [
            ("n", Word::Toward(Some(0.0))),
            ("e", Word::Toward(Some(90.0))),
            ("d", Word::Way(Component::Down)),
        ];
        *words = letters.map(|(text, one)| (text.to_string(), one)).to_vec();
    }
}
