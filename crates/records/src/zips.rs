//! How many files a zip has, counted before its directory is read: a reader holds a name and more for each, whatever
//! the directory declares.

use std::io::{self, Read};

/// Most files in a zip, and in a folder, that are looked at.
pub const MOST_FILES: usize = 100_000;

/// What each file's place in the directory of a zip begins with.
pub const ENTRY: &[u8; 4] = b"PK\x01\x02";

/// Checks how many files a zip has.
///
/// # Errors
/// Those of reading; [`io::ErrorKind::FileTooLarge`] where there are more than [`MOST_FILES`].
pub fn check(mut zip: impl Read) -> io::Result<()> {
    let mut buffer = vec![0; 1 << 16];
    // Bytes of the buffer that the piece before has left: an entry may begin in them.
    let (mut kept, mut files) = (0, 0);
    loop {
        let read = match zip.read(&mut buffer[kept..]) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            read => read?,
        };
        if read == 0 {
            return Ok(());
        }
        let held = kept + read;
        files += buffer[..held].windows(ENTRY.len()).filter(|bytes| bytes == ENTRY).count();
        if files > MOST_FILES {
            let problem = format!("more than {MOST_FILES} files");
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
        }
        kept = held.min(ENTRY.len() - 1);
        buffer.copy_within(held - kept..held, 0);
    }
}
