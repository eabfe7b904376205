//! Files that are held as a whole, up to a size: a larger one, and one without an end, is refused.

use std::fs::File;
use std::io::{self, Error, ErrorKind, Read};
use std::path::Path;

/// Most bytes of a text that tells what was run, such as run.json: axes that are long lists stand in it.
pub const DOCUMENT: u64 = 32 << 20;

/// The bytes of a file of `most` bytes at most.
///
/// # Errors
/// Errors of the disk; [`ErrorKind::FileTooLarge`] of a larger file.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // A device or a pipe has no length to be asked for.
    all(File::open(path)?, most)
}

/// The text of a file of `most` bytes at most.
///
/// # Errors
/// Those of [`read`]; [`ErrorKind::InvalidData`] of bytes that are no [`unicode`].
pub fn text(path: &Path, most: u64) -> io::Result<String> {
    let bytes = read(path, most)?;
    unicode(&bytes).ok_or_else(|| Error::new(ErrorKind::InvalidData, "no text in UTF-8"))
}

/// The text of bytes in UTF-8, or in UTF-16 with its byte order mark, in which Windows PowerShell writes what a command
/// prints (`>`). The mark is left out. None of other bytes.
pub fn unicode(bytes: &[u8]) -> Option<String> {
    match bytes {
        [0xff, 0xfe, rest @ ..] => Some(utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Some(utf16(rest, u16::from_be_bytes)),
        [0xef, 0xbb, 0xbf, rest @ ..] | rest => str::from_utf8(rest).ok().map(String::from),
    }
}

/// The text of bytes in UTF-16 of either order.
pub(super) fn utf16(bytes: &[u8], number: fn([u8; 2]) -> u16) -> String {
    let (units, _) = bytes.as_chunks::<2>();
    let units: Vec<u16> = units.iter().map(|unit| number(*unit)).collect();
    String::from_utf16_lossy(&units)
}

/// All bytes of a stream that has `most` at most.
///
/// # Errors
/// Those of the stream; [`ErrorKind::FileTooLarge`] of a longer one.
pub fn all(stream: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let problem = format!("larger than {}", size(most));
        return Err(Error::new(ErrorKind::FileTooLarge, problem));
    }
    Ok(bytes)
}

/// A size in the unit of which it is a whole number.
pub fn size(bytes: u64) -> String {
    match bytes {
        bytes if bytes % (1 << 30) == 0 => format!("{} GiB", bytes >> 30),
        bytes if bytes % (1 << 20) == 0 => format!("{} MiB", bytes >> 20),
        bytes => format!("{bytes} bytes"),
    }
}

#[cfg(test)]
mod tests {
    use std::io;

    use super::{all, size, unicode};

    #[test]
    fn what_is_larger_or_has_no_end_is_refused() {
        assert_eq!(all(&[7; 10][..], 10).unwrap(), [7; 10]);
        let refused = all(io::repeat(7), 3 << 20).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(refused.to_string(), "larger than 3 MiB");
        assert_eq!([2 << 30, 1000].map(size), ["2 GiB", "1000 bytes"]);
    }

    #[test]
    fn what_a_shell_of_windows_writes_is_text() {
        let text = "title = \"ä\"\r\n";
        let marked: Vec<u16> = std::iter::once(0xfeff).chain(text.encode_utf16()).collect();
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = marked.iter().copied().flat_map(order).collect();
            assert_eq!(unicode(&bytes).as_deref(), Some(text));
        }
        assert_eq!(unicode(format!("\u{feff}{text}").as_bytes()).as_deref(), Some(text));
        assert_eq!(unicode(text.as_bytes()).as_deref(), Some(text));
        assert_eq!(unicode(b"title = \"\xe4\""), None);
    }
}
