//! The lock of a run's folder: one run at a time, from before the folder is made until it is gone.
//!
//! It is a file beside the folder, which may so be renamed and removed while it is held. The file goes with its last
//! holder. Whoever had opened it before then has a lock of no name, and opens the one of the name again.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use super::busy::is_busy;
use super::store_error::StoreError;
use super::temporary;

/// How often a lock is tried. A child of this process that is just being started holds what this
/// process held until it runs its own program: an instant.
const ATTEMPTS: u32 = 10;
/// Pause between them.
const PAUSE: Duration = Duration::from_millis(20);

/// Who may hold a lock at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// One run.
    Alone,
    /// Any number of runs, none of them alone.
    Together,
}

/// A lock that is held.
#[derive(Debug)]
pub struct Lock {
    /// None once it is given up.
    file: Option<File>,
    path: PathBuf,
    holds: Holds,
}

/// Locks a folder, whose directory is there; `place` is what the user knows it by.
///
/// # Errors
/// [`StoreError::InUse`]; those of the disk.
pub fn lock(folder: &Path, place: &Path, holds: Holds) -> Result<Lock, StoreError> {
    let path = path(folder);
    let failed = |reason: io::Error| StoreError::file(&path)(reason);
    for attempt in 0..ATTEMPTS {
        if attempt > 0 {
            thread::sleep(PAUSE);
        }
        let file = match open(&path) {
            Err(error) if is_busy(&error) => continue,
            file => file.map_err(failed)?,
        };
        let locked = match holds {
            Holds::Alone => file.try_lock(),
            Holds::Together => file.try_lock_shared(),
        };
        match locked {
            Ok(()) if !is_at(&file, &path).map_err(failed)? => {}
            Err(TryLockError::WouldBlock) => {}
            // On a network's disk another machine has just taken it away.
            Err(TryLockError::Error(reason))
                if reason.kind() == ErrorKind::StaleNetworkFileHandle => {}
            // A file system that knows no locks, as some of clusters do, is used without; parts of a suite, of which each
            // file is one's own, are on any.
            Err(TryLockError::Error(reason))
                if holds == Holds::Alone && reason.kind() != ErrorKind::Unsupported =>
            {
                return Err(failed(reason));
            }
            Ok(()) | Err(TryLockError::Error(_)) => {
                return Ok(Lock { file: Some(file), path, holds });
            }
        }
    }
    Err(StoreError::InUse(place.to_path_buf()))
}

/// True where a run holds a folder's lock. That of one that was killed may lie there, and is free.
pub fn is_held(folder: &Path) -> bool {
    path(folder).exists() && matches!(lock(folder, folder, Holds::Alone), Err(StoreError::InUse(_)))
}

fn path(folder: &Path) -> PathBuf {
    folder
        .with_file_name(temporary::lock(&folder.file_name().unwrap_or_default().to_string_lossy()))
}

#[cfg(not(windows))]
fn open(path: &Path) -> io::Result<File> {
    // To hold it together a network's file system wants to read it, to hold it alone to write it.
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

/// Nobody can remove it while it is open.
#[cfg(windows)]
fn open(path: &Path) -> io::Result<File> {
    use std::os::windows::fs::OpenOptionsExt;
    const READ_AND_WRITE: u32 = 1 | 2;
    let mut options = OpenOptions::new();
    options
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .share_mode(READ_AND_WRITE)
        .open(path)
}

/// True where a file is the one of the name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let held = file.metadata()?;
    match fs::metadata(path) {
        Ok(there) => Ok((held.dev(), held.ino()) == (there.dev(), there.ino())),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

/// Elsewhere a file that is open keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> io::Result<bool> {
    Ok(true)
}

/// The file goes while it is held, so that nobody locks what is about to lose its name.
#[cfg(unix)]
fn give_up(file: File, path: &Path, holds: Holds) {
    let last = match holds {
        Holds::Alone => true,
        Holds::Together => file.try_lock().is_ok(),
    };
    if last {
        // What cannot be removed does no harm: the next run locks it again.
        let _ = fs::remove_file(path);
    }
    drop(file);
}

/// The file goes unless another run has it open, which then removes it.
#[cfg(not(unix))]
fn give_up(file: File, path: &Path, _: Holds) {
    drop(file);
    let _ = fs::remove_file(path);
}

impl Drop for Lock {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            give_up(file, &self.path, self.holds);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> (tempfile::TempDir, PathBuf) {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("unfinished");
        (place, folder)
    }

    #[test]
    fn a_lock_is_held_alone_or_together() {
        let (place, folder) = folder();
        let asked = |holds| lock(&folder, place.path(), holds);
        let alone = asked(Holds::Alone).unwrap();
        assert!(matches!(asked(Holds::Alone), Err(StoreError::InUse(_))));
        assert!(matches!(asked(Holds::Together), Err(StoreError::InUse(_))));
        drop(alone);
        let (one, other) = (asked(Holds::Together).unwrap(), asked(Holds::Together).unwrap());
        drop(one);
        // One is still at it.
        assert!(matches!(asked(Holds::Alone), Err(StoreError::InUse(_))));
        assert!(is_held(&folder));
        drop(other);
        assert!(!path(&folder).exists(), "the last holder takes the file away");
        drop(asked(Holds::Alone).unwrap());
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
    }

    /// Who waits for a lock has its file open; when the holder has taken the file away, a lock on it keeps nobody out.
    #[cfg(unix)]
    #[test]
    fn a_file_that_lost_its_name_is_no_lock() {
        let (place, folder) = folder();
        let held = lock(&folder, place.path(), Holds::Alone).unwrap();
        let waiting = open(&path(&folder)).unwrap();
        assert!(is_at(&waiting, &path(&folder)).unwrap());
        drop(held);
        waiting.try_lock().unwrap();
        assert!(!is_at(&waiting, &path(&folder)).unwrap());
        let _next = lock(&folder, place.path(), Holds::Alone).unwrap();
        assert!(!is_at(&waiting, &path(&folder)).unwrap());
    }
}
