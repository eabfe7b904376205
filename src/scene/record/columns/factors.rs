//! Factors on the values that words above plain numbers state. They are said and not applied: a file does not tell whether
//! its values have them already.

use super::pieces::{Piece, listed, pieces};
use super::words::is_acceleration;

/// Words beside which a number is a factor, as they begin.
const SCALING: &str =
    "scal factor multipl amplif attenuat magnif divid gain times increased reduced escala skalier";

/// Words between one of those and its number.
const BETWEEN: &str = "\
    factor coefficient constant by a an the of is was were be with value values data samples acceleration \
    accelerations acc record used applied all about";

/// Words of a line whose number is another thing's.
const OF_OTHERS: &str = "\
    richter mercalli mmi magnitude intensity moment damping decimation decimated sampling sampled downsampled \
    resampled upsampled quality safety importance participation drawing map noise q probability period behaviour";

/// Words that a product beside them multiplies.
const VALUES: &str = "\
    values value data samples sample amplitude amplitudes record a ag accel ud ns ew z up vertical h n e u v \
    signal counts";

/// Words before a unit that stand for a factor.
const PREFIXES: &str = "milli micro kilo percent thousandth thousandths hundredth hundredths";

/// Words that are a factor by themselves.
const WHOLE: &str = "doubled tripled halved";

/// Words behind which a number is a factor where a colon stands between.
const STATED: &str = "calibration conversion";

/// Most pieces between a word and its number, and in a bracket about numbers.
const FARTHEST: usize = 12;

/// Greatest whole number behind an x that may count channels along x.
const COUNTED: f64 = 9.0;

/// The factor in a line: `scale factor: 0.001`, `multiplied by 9.81`, `Z*-1`, `values x 1000`, `(x1000)`.
pub(super) fn stated(line: &str) -> Option<String> {
    let pieces = pieces(line);
    let words = || pieces.iter().filter_map(|(piece, _)| word(piece));
    if words().any(|word| listed(OF_OTHERS, word)) {
        return None;
    }
    let negative = |factor: &String| factor.starts_with('-');
    let whole = || words().find(|word| listed(WHOLE, word)).map(|word| format!("'{word}'"));
    keyed(&pieces)
        .or_else(|| product(&pieces, false))
        .or_else(whole)
        .filter(|factor| negative(factor) || !is_one(factor))
}

/// The factor in the name of a column, its units left out: `acc*1000`, `acc/9.81`, `acc x 1000`, `UD (-1)`, `1e-3 acc`.
pub(super) fn of_name(name: &str) -> Option<String> {
    let pieces = pieces(name);
    let prefix =
        || pieces.iter().filter_map(|(piece, _)| word(piece)).find(|word| listed(PREFIXES, word));
    keyed(&pieces)
        .or_else(|| product(&pieces, true))
        .or_else(|| prefix().map(|word| format!("'{word}'")))
        .filter(|factor| !is_one(factor))
}

fn is_one(factor: &str) -> bool {
    ["1", "1/1"].contains(&factor)
}

fn word(piece: &Piece) -> Option<&str> {
    match piece {
        Piece::Word(text) => Some(text),
        _ => None,
    }
}

/// A number from a place on, with its sign, and the place behind it.
fn number(pieces: &[(Piece, bool)], at: usize) -> Option<(f64, usize)> {
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

/// The factor behind a word of scaling, or before `times` and `x` behind one.
fn keyed(pieces: &[(Piece, bool)]) -> Option<String> {
    let is_key = |piece: &Piece| {
        word(piece).is_some_and(|word| {
            SCALING.split(' ').any(|begins| word.starts_with(begins)) || listed(STATED, word)
        })
    };
    pieces.iter().enumerate().filter(|(_, (piece, _))| is_key(piece)).find_map(
        |(key, (piece, _))| {
            let passed = |piece: &Piece| match piece {
                Piece::Word(word) => listed(BETWEEN, word) || is_key(piece),
                Piece::Other(c) => matches!(c, ':' | '=' | ','),
                _ => false,
            };
            let rest = &pieces[key + 1..];
            let from =
                key + 1 + rest.iter().take(FARTHEST).take_while(|(piece, _)| passed(piece)).count();
            let (value, end) = number(pieces, from)?;
            let stated = matches!(pieces[from - 1].0, Piece::Other(':' | '='));
            if !stated && word(piece).is_some_and(|word| listed(STATED, word)) {
                return None;
            }
            let of_ratio =
                matches!(pieces.get(end), Some((Piece::Other(':' | '%') | Piece::Hyphen, _)));
            let divided = word(piece).is_some_and(|word| word.starts_with("divid"));
            (!of_ratio).then(|| if divided { format!("1/{value}") } else { value.to_string() })
        },
    )
}

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
fn product(pieces: &[(Piece, bool)], of_name: bool) -> Option<String> {
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
            Piece::Minus if matches!(next, Some((Piece::Number(_), _))) => {
                at += 1;
                Term::Number(of_next.map_or(0.0, |number| -number))
            }
            Piece::Number(number) => Term::Number(*number),
            Piece::Product => Term::Product,
            Piece::Over => Term::Over,
            Piece::Power => Term::Power,
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
                    (None, Some(Term::Number(_))) => of_name && (*touches || terms.len() == 1),
                    _ => false,
                };
                if is_sign { Term::Product } else { Term::Other }
            }
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
        piece => word(piece) == Some("x"),
    };
    let end = open + 1 + inside;
    pieces[open + 1..end].iter().all(is_part).then_some(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_stand_behind_their_words_and_in_products() {
        for (line, factor) in [
            ("Scale factor: 0.001", "0.001"),
            ("multiply by 9.81 for m/s2", "9.81"),
            ("scale=0.5", "0.5"),
            ("scaled by 2", "2"),
            ("scaled by a factor of 1.5", "1.5"),
            ("amplified 2x", "2"),
            ("divided by 981", "1/981"),
            ("gain: -1", "-1"),
            ("values times -1", "-1"),
            ("values x 1000", "1000"),
            ("acc * 0.5", "0.5"),
            ("Z*-1", "-1"),
            ("Z * (-1) (g)", "-1"),
            ("-1*Z", "-1"),
            ("(-1) \u{d7} UD", "-1"),
            ("Z x -1", "-1"),
            ("(x1000)", "1000"),
            ("values (x 1000)", "1000"),
            ("conversion: 0.001", "0.001"),
            ("amplitudes doubled", "'doubled'"),
        ] {
            assert_eq!(stated(line).as_deref(), Some(factor), "{line}");
        }
        for line in [
            "scale factor = 1.0",
            "again 3",
            "m/s**2",
            "m*s**-2",
            "m/s*s",
            "HNX -1",
            "Z - 1",
            "cm*s-2",
            "filter: 0.1-25 Hz x 2 passes",
            "2 x 2 array",
            "Richter scale: 6.9",
            "damping factor 0.05",
            "scaled to PGA 0.4 g",
            "scale 1:10",
            "Vs30 = 250 m/s",
            "X 1",
            "amplification at 2 Hz",
            "10/15/1979",
        ] {
            assert_eq!(stated(line), None, "{line}");
        }
    }

    #[test]
    fn factors_of_a_column_stand_in_its_name() {
        for (name, factor) in [
            ("acc*1000", "1000"),
            ("acc/9.81", "1/9.81"),
            ("acc x 1000", "1000"),
            ("acc (x1000)", "1000"),
            ("acc (x2)", "2"),
            ("acc x0.5", "0.5"),
            ("acc 2x", "2"),
            ("1000*acc", "1000"),
            ("1e-3 acc", "0.001"),
            ("acc 10^-3", "0.001"),
            ("acc (1/1000)", "1/1000"),
            ("UD (-1)", "-1"),
            ("Z*1000", "1000"),
            ("acc/(9.81)", "1/9.81"),
            ("acc milli g", "'milli'"),
            ("1e3 x acc", "1000"),
        ] {
            assert_eq!(of_name(name).as_deref(), Some(factor), "{name}");
        }
        for name in [
            "CH 2",
            "acc_N107E",
            "IWT010.UD1",
            "T-2 acc",
            "A-C-E 1",
            "090 Deg",
            "X 1",
            "acc x1",
            "HN1",
            "acc m/s^2",
            "acc m/s2",
            "acc (5 Hz)",
            "ch 1/2",
            "acc 25",
            "S45W",
        ] {
            assert_eq!(of_name(name), None, "{name}");
        }
    }
}
