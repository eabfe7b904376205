//! From the bytes of a file to its text: other encodings are converted to UTF-8, and a file that is not a record is recognised
//! by its first bytes.

use super::{RecordError, other_programs, packed, plain};
use crate::scene::bounded;
use crate::scene::shown::is_hidden;

/// Largest file that is read, bytes; of a packed one also what is in it.
pub(crate) const LARGEST: u64 = 256 << 20;
/// A file that is smaller, packed or not, may be read beside others: more of them at once would fill the memory.
pub(crate) const SMALL: u64 = 8 << 20;
/// Most bytes of a line: its fields are held together, and a record's lines are short.
const LONGEST_LINE: usize = 1 << 24;

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

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Write};

    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    use super::*;
    use crate::scene::record::packed::unpacked;

    fn of(bytes: &[u8], most: u64) -> Result<(String, Option<String>), RecordError> {
        let (bytes, note) = unpacked(bytes, most)?;
        Ok((decoded(&bytes)?, note))
    }

    fn zipped(files: &[(&str, &str)]) -> Vec<u8> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in files {
            archive.start_file(*name, SimpleFileOptions::default()).unwrap();
            archive.write_all(text.as_bytes()).unwrap();
        }
        archive.finish().unwrap().into_inner()
    }

    #[test]
    fn a_line_without_an_end_is_refused() {
        let long = [b"1\n", &vec![b'1'; LONGEST_LINE + 1][..]].concat();
        let error = of(&long, LARGEST).unwrap_err().to_string();
        assert_eq!(error, "line 2: longer than 16 MiB; give the record with a few values a line");
    }

    #[test]
    fn other_encodings_are_read() {
        let text = "\u{feff}Erdbeben ä\n1\n";
        let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
        assert_eq!(read, "Erdbeben ä\n1\n");
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = text.encode_utf16().flat_map(order).collect();
            assert_eq!(of(&bytes, LARGEST).unwrap().0, "Erdbeben ä\n1\n");
        }
    }

    #[test]
    fn lines_end_however_systems_end_them() {
        for text in [
            "1\r2\r3",
            "1\r\n2\r\n3",
            "1\r\r\n2\r\r\n3\r\r\n",
            "1\n2\n3\n\x1a",
            "1\n2\r\n3\r\n\x1a\x1a\0\0",
            "\u{feff}\u{feff}1\n2\n3",
        ] {
            let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
            assert_eq!(read.lines().collect::<Vec<_>>(), ["1", "2", "3"], "{text:?}");
        }
        // Amid a text it ends nothing.
        assert!(of(b"1\n\x1a2\n", LARGEST).unwrap().0.contains('\x1a'));
        let wide: Vec<u8> =
            "0.123456 0.234567\n0.3".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(of(&wide, LARGEST).unwrap().0, "0.123456 0.234567\n0.3");
    }

    #[test]
    fn what_is_no_record_is_named() {
        let xlsx = zipped(&[("xl/workbook.xml", ""), ("xl/a.xml", "")]);
        let mut seed = b"000001D XXX  HNE".to_vec();
        seed.resize(512, 0);
        for (bytes, said) in [(&xlsx, "save its sheet as CSV"), (&seed, "miniSEED")] {
            let error = of(bytes, LARGEST).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
            // Lists and hazard curves are not unpacked.
            let error = decoded(bytes).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        for (bytes, said) in [
            (&b"  <!DOCTYPE html><html>"[..], "a web page"),
            (b"<html><body>Login", "a web page"),
            (b"%PDF-1.7", "a PDF"),
            (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a binary file"),
        ] {
            let error = of(bytes, LARGEST).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        assert_eq!(printable("a\u{1b}[31mb\u{7}"), "a[31mb");
        assert_eq!(printable("a\r\nb\tc\nd"), "a b c d");
        let hidden = "\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}\u{200b}\u{200d}\u{2060}\u{feff}\u{200e}\u{ad}";
        assert_eq!(printable(&format!("a{hidden}b \u{627}\u{3b1}")), "ab \u{627}\u{3b1}");
    }
}
