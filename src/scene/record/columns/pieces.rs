//! A line cut into words, numbers and signs. Which `-` is a sign, and which is a hyphen or a dash, is decided here alone.

/// A piece of a line.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    /// Letters, in lower case.
    Word(String),
    /// Digits, with the exponent behind them. The sign before them is a piece of its own.
    Number(f64),
    Minus,
    Plus,
    Hyphen,
    Product,
    Over,
    Power,
    Open,
    Close,
    Other(char),
}

/// Longest part of a line that is read, in letters.
const LONGEST: usize = 1000;

/// True of a word in a list of words.
pub(super) fn listed(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|one| one == word)
}

/// True of a word of an acceleration.
pub(super) fn is_acceleration(word: &str) -> bool {
    ["acc", "beschl", "acel", "accél"].iter().any(|begins| word.starts_with(begins))
}

/// The pieces of a line, each with true where it touches the one before.
pub(super) fn pieces(line: &str) -> Vec<(Piece, bool)> {
    let chars: Vec<char> = lower(line).chars().take(LONGEST).collect();
    let mut found = Vec::new();
    let (mut at, mut end) = (0, usize::MAX);
    while at < chars.len() {
        if chars[at].is_whitespace() {
            at += 1;
            continue;
        }
        let (piece, next) = piece(&chars, at);
        found.push((piece, at == end));
        (at, end) = (next, next);
    }
    found
}

/// A line in lower case, with the dashes of word processors as those of a keyboard.
pub(super) fn lower(line: &str) -> String {
    dashes(line).to_lowercase()
}

/// A line with the signs of word processors as those of a keyboard: dashes, pluses, arrows.
pub(super) fn dashes(line: &str) -> String {
    const LONG: [char; 7] =
        ['\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}', '\u{2212}', '\u{ff0d}'];
    let plain = line.replace(LONG, "-").replace(['\u{ff0b}', '\u{fe62}'], "+");
    plain.replace('\u{2193}', " down ").replace('\u{2191}', " up ")
}

/// The piece that begins at a place, and the place behind it.
fn piece(chars: &[char], at: usize) -> (Piece, usize) {
    let is = |at: usize, is: fn(char) -> bool| chars.get(at).is_some_and(|c| is(*c));
    let run = |from: usize, part: fn(char) -> bool| {
        chars[from..].iter().position(|c| !part(*c)).map_or(chars.len(), |count| from + count)
    };
    let is_digit = |c: char| c.is_ascii_digit();
    let c = chars[at];
    if c.is_alphabetic() {
        let end = run(at, char::is_alphabetic);
        return (Piece::Word(chars[at..end].iter().collect()), end);
    }
    let behind_word = at > 0 && is(at - 1, |c| c.is_alphabetic() || ".)]".contains(c));
    if is_digit(c) || c == '.' && !behind_word && is(at + 1, |c| c.is_ascii_digit()) {
        let mut end = run(at, |c| c.is_ascii_digit() || c == '.');
        let sign = usize::from(is(end + 1, |c| matches!(c, '+' | '-')));
        if chars.get(end) == Some(&'e') && is(end + 1 + sign, |c| c.is_ascii_digit()) {
            let exponent = run(end + 1 + sign, |c| c.is_ascii_digit());
            if !is(exponent, char::is_alphanumeric) || sign == 1 {
                end = exponent;
            }
        }
        let text: String = chars[at..end].iter().collect();
        return (text.parse().map_or(Piece::Other('.'), Piece::Number), end);
    }
    let one = match c {
        '*' if chars.get(at + 1) == Some(&'*') => return (Piece::Power, at + 2),
        '*' | '\u{d7}' | '\u{b7}' => Piece::Product,
        '^' => Piece::Power,
        '/' | '\u{f7}' => Piece::Over,
        '(' | '[' => Piece::Open,
        ')' | ']' => Piece::Close,
        '+' => Piece::Plus,
        '-' if is_sign(chars, at) => Piece::Minus,
        '-' => Piece::Hyphen,
        c => Piece::Other(c),
    };
    (one, at + 1)
}

/// True of a `-` that is a sign: before a word or a number and apart from what stands before, or behind all of them.
fn is_sign(chars: &[char], at: usize) -> bool {
    let before = at.checked_sub(1).map(|at| chars[at]);
    let next = chars.get(at + 1).copied();
    let begins = |c: char| c.is_alphanumeric() || matches!(c, '.' | '(');
    // A rule of dashes.
    if before == Some('-') || next == Some('-') {
        return false;
    }
    if next.is_some_and(begins) {
        return before.is_none_or(|c| !(c.is_alphanumeric() || matches!(c, '.' | ')' | ']')));
    }
    let after = chars[at + 1..].iter().find(|c| !c.is_whitespace());
    let first = chars[..at].iter().all(|c| c.is_whitespace());
    first || matches!(before, Some('(' | '[')) || after.is_none_or(|c| "()[],;/".contains(*c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_stands_before_what_follows_or_behind_all() {
        let signs =
            |line: &str| pieces(line).iter().filter(|(one, _)| *one == Piece::Minus).count();
        for line in [
            "-Z",
            "Z-",
            "UD (-)",
            "UD \u{2212} (g)",
            "UD\u{2013}",
            "acc_-UD",
            "- UD",
            "UD (- up)",
            "a -down",
            "= -1",
            "Z*-1",
            "-(UD)",
        ] {
            assert_eq!(signs(line), 1, "{line}");
        }
        for line in [
            "Up-Down",
            "N\u{2013}S",
            "Kobe - UD",
            "Acc.-X",
            "T-2 acc",
            "1e-3 g",
            "-----",
            "pre- and post-event",
            "cm.s-2",
        ] {
            assert_eq!(signs(line), 0, "{line}");
        }
    }

    #[test]
    fn numbers_have_their_exponents_and_touch_their_words() {
        let of = |line: &str| pieces(line);
        assert_eq!(of("1E-3*x")[0].0, Piece::Number(1e-3));
        assert_eq!(of("2x"), [(Piece::Number(2.0), false), (Piece::Word("x".into()), true)]);
        assert_eq!(of("N107E").len(), 3);
        assert_eq!(of("acc.090")[2].0, Piece::Number(90.0));
        assert_eq!(of("1.2.3"), [(Piece::Other('.'), false)]);
        assert_eq!(of("a ** .5")[1..], [(Piece::Power, false), (Piece::Number(0.5), false)]);
    }
}
