//! From the bytes of a file to its text: other encodings are converted to UTF-8, and a file that is not a record is recognised
//! by its first bytes.

use super::shown::is_hidden;
use super::{RecordError, bounded, other_programs, packed, plain};

/// Largest file that is read, bytes; of a packed one also what is in it.
pub const LARGEST: u64 = 256 << 20;
/// A file that is smaller, packed or not, may be read beside others: more of them at once would fill the memory.
pub(crate) const SMALL: u64 = 8 << 20;
/// Most bytes of a line: its fields are held together, and a record's lines are short.
pub const LONGEST_LINE: usize = 1 << 24;

/// Bytes as text, in UTF-8, UTF-16, or else Latin-1; its lines ended as here.
///
/// # Errors
/// What it is, where it is no text, and what to do.
pub fn decoded(bytes: &[u8]) -> Result<String, RecordError> {
    let text = plain::of(bytes);
    if bytes.starts_with(b"%PDF") {
        return Err(RecordError::whole("a PDF, not a record; give the file of numbers"));
    }
    let other = other_programs::of(bytes).or_else(|| packed::of_program(bytes));
    if let Some(problem) = other.map(String::from).or_else(|| other_programs::of_text(&text)) {
        return Err(RecordError::whole(problem));
    }
    if text.chars().take(1024).any(|c| c == '\0') {
        return Err(RecordError::whole("a binary file, not a record; give a file of numbers"));
    }
    let long = text.lines().position(|line| line.len() > LONGEST_LINE);
    if let Some(before) = long {
        let most = bounded::size(LONGEST_LINE as u64);
        let problem = format!("longer than {most}; give the record with a few values a line");
        return Err(RecordError::line(before + 1, problem));
    }
    Ok(text)
}

/// Bytes as text in whatever encoding, whatever they are.
pub fn plain(bytes: &[u8]) -> String {
    plain::of(bytes)
}

/// A name or a title from a file as it is shown, in one line: a blank for a line break or a tab, and without other characters
/// that a terminal obeys, an SVG may not hold, or nobody sees.
pub fn printable(text: &str) -> String {
    let blank = |c: char| if c.is_control() && c.is_whitespace() { ' ' } else { c };
    text.replace("\r\n", "\n").chars().map(blank).filter(|c| !is_hidden(*c)).collect()
}
