//! Bytes of a text file in whatever encoding, with whatever line ends.

use super::bounded::{self, utf16};

/// The bytes as text, its lines ended as they are here.
pub(super) fn of(bytes: &[u8]) -> String {
    let text = match bytes {
        _ if is_wide(bytes, 1) => utf16(bytes, u16::from_le_bytes),
        _ if is_wide(bytes, 0) => utf16(bytes, u16::from_be_bytes),
        _ => bounded::unicode(bytes).unwrap_or_else(|| western(bytes)),
    };
    lines_of_here(text)
}

/// A text in Latin-1, or in Windows' encoding of it, whose dashes may be signs.
fn western(bytes: &[u8]) -> String {
    let letter = |byte: &u8| match byte {
        0x96 => '\u{2013}',
        0x97 => '\u{2014}',
        byte => char::from(*byte),
    };
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).iter().map(letter).collect()
}

/// Number of letters by which a text in UTF-16 without a byte order mark is recognised.
const WIDE: usize = 32;

/// True of a text in UTF-16 without a mark: every other byte of its beginning is a zero, from `zero` on.
fn is_wide(bytes: &[u8], zero: usize) -> bool {
    bytes.len() >= WIDE
        && bytes[..WIDE].iter().enumerate().all(|(at, byte)| (*byte == 0) == (at % 2 == zero))
}

/// A text without the marks that programs put before it, and what ends a file of DOS; its lines end as they do here.
fn lines_of_here(text: String) -> String {
    let begun = text.trim_start_matches('\u{feff}');
    let plain = begun.trim_end_matches(['\u{1a}', '\0', ' ', '\t', '\r', '\n']);
    // A line's end stays where nothing follows it.
    let plain = if begun.len() > plain.len() && begun[plain.len()..].contains(['\u{1a}', '\0']) {
        plain
    } else {
        begun
    };
    let lone = plain.as_bytes().windows(2).any(|pair| pair[0] == b'\r' && pair[1] != b'\n');
    if !lone {
        return if plain.len() == text.len() { text } else { plain.to_string() };
    }
    // Any number of returns before a line feed end one line.
    let mut lines = String::with_capacity(plain.len());
    let mut returns = 0;
    for c in plain.chars() {
        match c {
            '\r' => returns += 1,
            '\n' => {
                lines.push('\n');
                returns = 0;
            }
            c => {
                lines.extend(std::iter::repeat_n('\n', returns));
                lines.push(c);
                returns = 0;
            }
        }
    }
    lines
}
