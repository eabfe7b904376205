//! The lock of a run's folder: one run at a time.

use std::fs::{File, TryLockError};
use std::io::ErrorKind;
use std::path::Path;
use std::thread;
use std::time::Duration;

use super::store_error::StoreError;

/// Name of the file that a running sweep holds locked.
pub const NAME: &str = "lock";

/// Times that a lock is asked for. A child of this process that is just being started holds what this
/// process held until it runs its own program: an instant.
const ATTEMPTS: u32 = 10;
/// Pause between them.
const PAUSE: Duration = Duration::from_millis(20);

/// Locks a folder; `place` is what the user knows it by.
pub fn lock(folder: &Path, place: &Path) -> Result<File, StoreError> {
    let path = folder.join(NAME);
    let lock = File::create(&path).map_err(StoreError::file(&path))?;
    let mut locked = lock.try_lock();
    for _ in 1..ATTEMPTS {
        if !matches!(locked, Err(TryLockError::WouldBlock)) {
            break;
        }
        thread::sleep(PAUSE);
        locked = lock.try_lock();
    }
    match locked {
        Ok(()) => Ok(lock),
        Err(TryLockError::WouldBlock) => Err(StoreError::InUse(place.to_path_buf())),
        // A file system that knows no locks, as some of clusters do, is used without.
        Err(TryLockError::Error(reason)) if reason.kind() == ErrorKind::Unsupported => Ok(lock),
        Err(TryLockError::Error(reason)) => Err(StoreError::file(&path)(reason)),
    }
}
