//! How many files a zip may have.

use topple_records::zips::{ENTRY, MOST_FILES, check};

/// Gives three bytes at a time: entries are cut.
struct Drops<'a>(&'a [u8]);

impl std::io::Read for Drops<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let most = buffer.len().min(3);
        self.0.read(&mut buffer[..most])
    }
}

#[test]
fn files_are_counted_however_they_arrive() {
    let most = [b"PK", &ENTRY.repeat(MOST_FILES)[..]].concat();
    assert!(check(&most[..]).is_ok() && check(Drops(&most)).is_ok());
    let more = [&most[..], b"..", ENTRY].concat();
    assert!(check(&more[..]).is_err() && check(Drops(&more)).is_err());
}
