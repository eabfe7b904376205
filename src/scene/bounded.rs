//! Files that are held as a whole, up to a size: a larger one, and one without an end, is refused.

use std::fs::File;
use std::io::{self, Error, ErrorKind, Read};
use std::path::Path;

/// Most bytes of a text that tells what was run, such as run.json: axes that are long lists stand in it.
pub const DOCUMENT: u64 = 32 << 20;

/// The bytes of a file of `most` bytes at most.
///
/// # Errors
/// Those of the disk; [`ErrorKind::FileTooLarge`] of a larger file.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // A device or a pipe has no length to be asked for.
    all(File::open(path)?, most)
}

/// The text of a file of `most` bytes at most.
///
/// # Errors
/// Those of [`read`]; [`ErrorKind::InvalidData`] of bytes that are no UTF-8.
pub fn text(path: &Path, most: u64) -> io::Result<String> {
    let bytes = read(path, most)?;
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "no text in UTF-8"))
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

    use super::{all, size};

    #[test]
    fn what_is_larger_or_has_no_end_is_refused() {
        assert_eq!(all(&[7; 10][..], 10).unwrap(), [7; 10]);
        let refused = all(io::repeat(7), 3 << 20).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(refused.to_string(), "larger than 3 MiB");
        assert_eq!([2 << 30, 1000].map(size), ["2 GiB", "1000 bytes"]);
    }
}
