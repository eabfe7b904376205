//! Files that another program has open for a moment.

use std::io;
use std::thread;
use std::time::Duration;

/// Does what the system refuses while another program has a file open, for a second at most. On Windows a scanner of
/// viruses opens each new file for a moment, in which neither the file nor its folder can be renamed.
pub(super) fn patiently<T>(mut attempt: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    for _ in 0..20 {
        match attempt() {
            Err(error) if is_busy(&error) => thread::sleep(Duration::from_millis(50)),
            done => return done,
        }
    }
    attempt()
}

/// True of the error of a file that another program has open for a moment, or that another run is just removing.
#[cfg(not(windows))]
pub(super) fn is_busy(_: &io::Error) -> bool {
    false
}

#[cfg(windows)]
pub(super) fn is_busy(error: &io::Error) -> bool {
    const SHARING_VIOLATION: i32 = 32;
    error.raw_os_error() == Some(SHARING_VIOLATION)
        || error.kind() == io::ErrorKind::PermissionDenied
}
