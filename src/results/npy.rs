//! Arrays in numpy's format NPY 1.0: the header, and the text of an array without an index.
//!
//! The format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>

use std::io;

/// The first bytes of every array: the name of the format and its version.
const MAGIC: &[u8; 8] = b"\x93NUMPY\x01\x00";
/// An array begins at a multiple of so many bytes.
const ALIGNMENT: usize = 64;
/// Most bytes of the header of an array without an index: numpy writes 118.
const LARGEST_HEADER: usize = 512;

/// The header of an array of values of a type, by its name in numpy: the last index fastest.
pub fn header(of: &str, shape: &[u64]) -> Vec<u8> {
    // As Python writes a tuple: one of one number ends with a comma.
    let shape = match shape {
        [count] => format!("{count},"),
        counts => counts.iter().map(u64::to_string).collect::<Vec<_>>().join(", "),
    };
    let mut text = format!("{{'descr': '{of}', 'fortran_order': False, 'shape': ({shape}), }}");
    let length = MAGIC.len() + 2;
    let filled = (length + text.len() + 1).next_multiple_of(ALIGNMENT) - length;
    text.extend(std::iter::repeat_n(' ', filled - text.len() - 1));
    text.push('\n');
    // A scene has six axes at most, so the header is far below 64 KiB.
    [MAGIC, (text.len() as u16).to_le_bytes().as_slice(), text.as_bytes()].concat()
}

/// The text of an array of letters without an index.
///
/// # Errors
/// The array is no such array.
pub fn text(array: &[u8]) -> io::Result<String> {
    let none = || io::Error::other("no text without an index");
    let rest = array.strip_prefix(MAGIC).ok_or_else(none)?;
    let (length, rest) = rest.split_first_chunk().ok_or_else(none)?;
    let length = usize::from(u16::from_le_bytes(*length));
    if length > LARGEST_HEADER || length > rest.len() {
        return Err(none());
    }
    let (header, letters) = rest.split_at(length);
    let header: String = header
        .iter()
        .map(|byte| char::from(*byte))
        .filter(|letter| !letter.is_whitespace())
        .collect();
    if !header.contains("'shape':()") {
        return Err(none());
    }
    let of: fn([u8; 4]) -> u32 = match header.split_once("'descr':'") {
        Some((_, kind)) if kind.starts_with("<U") => u32::from_le_bytes,
        Some((_, kind)) if kind.starts_with(">U") => u32::from_be_bytes,
        _ => return Err(none()),
    };
    let (letters, _) = letters.as_chunks::<4>();
    let letter =
        |letter: &[u8; 4]| char::from_u32(of(*letter)).unwrap_or(char::REPLACEMENT_CHARACTER);
    Ok(letters.iter().map(letter).collect())
}
