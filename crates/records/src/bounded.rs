//! Files that are held as a whole, up to a size: a larger one, and one without an end, is refused.

use std::fs::File;
use std::io::{self, Error, ErrorKind, Read};
use std::path::Path;
use std::time::Duration;
#[cfg(unix)]
use std::{sync::mpsc, thread};

/// Most bytes of a text that tells what was run, such as run.json: axes that are long lists stand in it.
pub const DOCUMENT: u64 = 32 << 20;

/// The bytes of a file of `most` bytes at most.
///
/// # Errors
/// Errors of the disk; [`ErrorKind::FileTooLarge`] of a larger file.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // A device or a pipe has no length to be asked for.
    all(opened(path, WAIT)?, most)
}

/// How long a pipe may have nobody who writes to it.
const WAIT: Duration = Duration::from_secs(30);

/// Opens a file. Opening a pipe by its name waits until somebody opens it to write, which may never be.
#[cfg(unix)]
pub fn opened(path: &Path, wait: Duration) -> io::Result<File> {
    use std::os::unix::fs::FileTypeExt;
    if !path.metadata().is_ok_and(|about| about.file_type().is_fifo()) {
        return File::open(path);
    }
    let (sender, receiver) = mpsc::channel();
    let path = path.to_path_buf();
    // Where nobody comes, the thread waits on to the end of the process.
    thread::Builder::new().spawn(move || sender.send(File::open(path)))?;
    let problem = || format!("a pipe that nobody has written to for {} s", wait.as_secs());
    let none = |_| Err(Error::new(ErrorKind::TimedOut, problem()));
    receiver.recv_timeout(wait).unwrap_or_else(none)
}

#[cfg(not(unix))]
pub fn opened(path: &Path, _: Duration) -> io::Result<File> {
    File::open(path)
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
pub fn utf16(bytes: &[u8], number: fn([u8; 2]) -> u16) -> String {
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
