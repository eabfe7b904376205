//! Numbers in products and divisions of words above plain numbers: `acc*1000`, `Z * (-1)`, `(x1000)`.

use super::pieces::{Piece, is_acceleration, listed};

/// Words that a product beside them multiplies.
const VALUES: &str = "\
    values value data samples sample amplitude amplitudes record a ag accel ud ns ew z up vertical h n e u v \
    signal counts";

/// Most pieces between a word and its number, and in a bracket about numbers.
pub(super) const FARTHEST: usize = 12;

/// Greatest whole number behind an x that may count channels along x.
const COUNTED: f64 = 9.0;

/// What a piece is to a product.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Term {
    /// What is multiplied.
    Values,
    Number(f64),
    Product,
    Over,
    Power,
    Other,
}

/// The factor beside the sign of a product or of a division. In the name of a column a power of ten and a negative number
/// are factors, too.
pub(super) fn product(pieces: &[(Piece, bool)], of_name: bool) -> Option<String> {
    let terms = terms(pieces, of_name);
    let term = |at: Option<usize>| at.and_then(|at| terms.get(at)).copied();
    (0..terms.len()).find_map(|at| {
        let Term::Number(number) = terms[at] else { return None };
        let [before, behind] = [term(at.checked_sub(1)), term(Some(at + 1))];
        let [left, right] = [term(at.checked_sub(2)), term(Some(at + 2))];
        let is_values = |one: Option<Term>| matches!(one, None | Some(Term::Values));
        let divided = left == Some(Term::Values)
            || of_name && left == Some(Term::Number(1.0)) && number > COUNTED;
        match (before, behind) {
            (Some(Term::Product), _) if is_values(left) || number < 0.0 => Some(number.to_string()),
            (_, Some(Term::Product)) if is_values(right) || number < 0.0 => {
                Some(number.to_string())
            }
            (Some(Term::Over), _) if divided => Some(format!("1/{number}")),
            (_, Some(Term::Power)) if of_name => match right {
                Some(Term::Number(power)) => Some(number.powf(power).to_string()),
                _ => None,
            },
            _ if of_name && (number < 0.0 || number > 0.0 && number < 0.1) => {
                Some(number.to_string())
            }
            _ => None,
        }
    })
}

/// The terms of a line: a sign belongs to its number, brackets about numbers are left out, and an x may be a product.
fn terms(pieces: &[(Piece, bool)], of_name: bool) -> Vec<Term> {
    let mut terms = Vec::new();
    let mut at = 0;
    // The end of a bracket about nothing but numbers.
    let mut numbers_to = 0;
    while let Some((piece, touches)) = pieces.get(at) {
        let next = pieces.get(at + 1);
        let of_next = number(pieces, at + 1).map(|(number, _)| number);
        terms.push(match piece {
            Piece::Minus | Piece::Hyphen
                if matches!(next, Some((Piece::Number(_), _)))
                    && (*piece == Piece::Minus
                        || of_name && terms.last() == Some(&Term::Product)) =>
            {
                at += 1;
                Term::Number(of_next.map_or(0.0, |number| -number))
            }
            Piece::Number(number) => Term::Number(*number),
            Piece::Product => Term::Product,
            Piece::Over => Term::Over,
            // `1:10` in brackets.
            Piece::Other(':') if at < numbers_to => Term::Over,
            Piece::Power => Term::Power,
            Piece::Other('_') => {
                at += 1;
                continue;
            }
            Piece::Open if let Some(end) = end_of_numbers(pieces, at) => {
                (numbers_to, at) = (end, at + 1);
                continue;
            }
            Piece::Close if at == numbers_to => {
                at += 1;
                continue;
            }
            Piece::Word(word) if word == "x" || word == "times" => {
                let touches_next = next.is_some_and(|(_, touches)| *touches);
                let is_sign = match (of_next, terms.last()) {
                    // Letters and their numbers are names of channels: x1.
                    (Some(number), _) if at > numbers_to && is_count(number) => {
                        !touches_next && !terms.is_empty()
                    }
                    (Some(_), _) => true,
                    (None, Some(Term::Number(_))) => {
                        let last = matches!(next, None | Some((Piece::Close, _)));
                        of_name && (*touches || last || terms.len() == 1)
                    }
                    _ => false,
                };
                if is_sign { Term::Product } else { Term::Other }
            }
            Piece::Word(_) if matches!(next, Some((Piece::Product, _))) => Term::Values,
            Piece::Word(word) if of_name || listed(VALUES, word) || is_acceleration(word) => {
                Term::Values
            }
            _ => Term::Other,
        });
        at += 1;
    }
    terms
}

fn is_count(number: f64) -> bool {
    number.fract() == 0.0 && (0.0..=COUNTED).contains(&number)
}

/// The end of a bracket that holds numbers and their signs alone.
fn end_of_numbers(pieces: &[(Piece, bool)], open: usize) -> Option<usize> {
    let inside =
        pieces[open + 1..].iter().take(FARTHEST).position(|(piece, _)| *piece == Piece::Close)?;
    let is_part = |(piece, _): &(Piece, bool)| match piece {
        Piece::Number(_) | Piece::Minus | Piece::Product | Piece::Over | Piece::Power => true,
        Piece::Hyphen | Piece::Other(':') => true,
        piece => word(piece) == Some("x"),
    };
    let end = open + 1 + inside;
    pieces[open + 1..end].iter().all(is_part).then_some(end)
}

pub(super) fn word(piece: &Piece) -> Option<&str> {
    match piece {
        Piece::Word(text) => Some(text),
        _ => None,
    }
}

/// A number from a place on, with its sign, and the place behind it.
pub(super) fn number(pieces: &[(Piece, bool)], at: usize) -> Option<(f64, usize)> {
    match (&pieces.get(at)?.0, pieces.get(at + 1).map(|(piece, _)| piece)) {
        (Piece::Number(value), _) => Some((*value, at + 1)),
        (Piece::Minus | Piece::Hyphen, Some(Piece::Number(value))) => Some((-value, at + 2)),
        (Piece::Open, Some(Piece::Number(value))) => Some((*value, at + 2)),
        (Piece::Open, Some(Piece::Minus)) => match pieces.get(at + 2)?.0 {
            Piece::Number(value) => Some((-value, at + 3)),
            _ => None,
        },
        _ => None,
    }
}
