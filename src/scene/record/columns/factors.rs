//! Factors on the values that words above plain numbers state. They are said and not applied: a file does not tell whether
//! its values have them already.

use super::pieces::{Piece, listed, pieces};
use super::products::{FARTHEST, number, product, word};

/// Words beside which a number is a factor, as they begin.
const SCALING: &str = "\
    scal factor multipli multiply amplif attenuat magnif divid normali gain increased reduced escala skalier";

/// Words between one of those and its number.
const BETWEEN: &str = "\
    factor coefficient constant by a an the of is was were be with value values samples acceleration \
    accelerations acc record used applied all about x up down linear";

/// Words of a line whose number is another thing's.
const OF_OTHERS: &str = "\
    richter mercalli mmi magnitude intensity moment damping decimation decimated sampling sampled downsampled \
    resampled upsampled quality safety importance participation drawing map noise q probability period behaviour";

/// Words before a unit that stand for a factor.
const PREFIXES: &str = "milli micro kilo percent thousandth thousandths hundredth hundredths";

/// Words that are a factor by themselves.
const WHOLE: &str = "doubled tripled halved";

/// Whole words of the same kind, and those beside which only a colon makes a number a factor.
const SHORT: &str = "div mult";
const STATED: &str = "calibration conversion sf lsb";

/// The factor in a line: `scale factor: 0.001`, `multiplied by 9.81`, `Z*-1`, `values x 1000`, `(x1000)`.
pub(super) fn stated(line: &str) -> Option<String> {
    let pieces = pieces(line);
    let words = || pieces.iter().filter_map(|(piece, _)| word(piece));
    if words().any(|word| listed(OF_OTHERS, word)) {
        return None;
    }
    let negative = |factor: &String| factor.starts_with('-');
    let whole = || words().find(|word| listed(WHOLE, word)).map(|word| format!("'{word}'"));
    keyed(&pieces, false)
        .or_else(|| product(&pieces, false))
        .or_else(whole)
        .filter(|factor| negative(factor) || !is_one(factor))
}

/// The factor in the name of a column, its units left out: `acc*1000`, `acc/9.81`, `acc x 1000`, `UD (-1)`, `1e-3 acc`.
pub(super) fn of_name(name: &str) -> Option<String> {
    let pieces = pieces(name);
    let prefix =
        || pieces.iter().filter_map(|(piece, _)| word(piece)).find(|word| listed(PREFIXES, word));
    keyed(&pieces, true)
        .or_else(|| product(&pieces, true))
        .or_else(|| prefix().map(|word| format!("'{word}'")))
        .filter(|factor| !is_one(factor))
}

fn is_one(factor: &str) -> bool {
    ["0", "1", "1/1", "100 %"].contains(&factor)
}

/// The factor behind a word of scaling, or before `times` and `x` behind one.
fn keyed(pieces: &[(Piece, bool)], of_name: bool) -> Option<String> {
    let is_key = |piece: &Piece| {
        word(piece).is_some_and(|word| {
            SCALING.split_ascii_whitespace().any(|begins| word.starts_with(begins))
                || listed(SHORT, word)
                || listed(STATED, word)
        })
    };
    pieces.iter().enumerate().filter(|(_, (piece, _))| is_key(piece)).find_map(
        |(key, (piece, _))| {
            let passed = |piece: &Piece| match piece {
                Piece::Word(word) => listed(BETWEEN, word) || is_key(piece) || word == "to",
                Piece::Open | Piece::Close => true,
                Piece::Other(c) => matches!(c, ':' | '=' | ',' | '_'),
                _ => false,
            };
            let rest = &pieces[key + 1..];
            let from =
                key + 1 + rest.iter().take(FARTHEST).take_while(|(piece, _)| passed(piece)).count();
            let (value, end) = number(pieces, from)?;
            let stated = matches!(pieces[from - 1].0, Piece::Other(':' | '='));
            if !stated && !of_name && word(piece).is_some_and(|word| listed(STATED, word)) {
                return None;
            }
            let full = key > 0 && word(&pieces[key - 1].0) == Some("full");
            // What is scaled to a peak has been scaled.
            let to = pieces[key..from].iter().any(|(piece, _)| word(piece) == Some("to"));
            let divided = word(piece).is_some_and(|word| word.starts_with("div"));
            match pieces.get(end) {
                _ if full => None,
                Some((Piece::Other('%'), _)) => Some(format!("{value} %")),
                Some((Piece::Other(':') | Piece::Hyphen, _)) => None,
                _ if to => None,
                _ if divided => Some(format!("1/{value}")),
                _ => Some(value.to_string()),
            }
        },
    )
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
            ("SF = 1.5", "1.5"),
            ("scaling: x2", "2"),
            ("scaled (x2)", "2"),
            ("Scale Factor (linear): 2", "2"),
            ("scaled down by 2", "2"),
            ("acc=raw*0.01", "0.01"),
            ("LSB = 0.001 g", "0.001"),
            ("mult: 2", "2"),
            ("scaled to 50%", "50 %"),
        ] {
            assert_eq!(stated(line).as_deref(), Some(factor), "{line}");
        }
        for line in [
            "scale factor = 1.0",
            "full scale: 2 g",
            "gain 0 dB",
            "at times 2 s",
            "multiplexed 4",
            "reduced data 2010",
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
            ("acc (x-1)", "-1"),
            ("acc (2 x)", "2"),
            ("acc (1:10)", "1/10"),
            ("acc_scaled_by_2", "2"),
            ("acc SF 2", "2"),
            ("acc_x1000", "1000"),
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
