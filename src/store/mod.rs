//! A sweep on disk while it runs: what is done is kept, so that an interrupted run goes on from there.
//!
//! A folder in the run's directory holds the run's [`Identity`], a lock, and tiles: runs of cells, each
//! a file of its own that appears whole or not at all. A whole map's is `unfinished`, and goes when the
//! map is written. A part's is `part-3-of-16`, and stays: a report is added when the part is done.

pub mod identity;
pub mod keeper;
pub mod part;
pub mod parts;
pub mod shelf;
pub mod tile;

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use crate::map::files::{Directory, WriteError};
use crate::stepping::outcome::Outcome;
use identity::Identity;
use parts::Report;
use tile::Tile;

/// Name of a whole map's folder in a run's directory.
const FOLDER: &str = "unfinished";
/// Name of the identity's file.
const IDENTITY: &str = "identity.json";
/// Name of a finished part's report.
const REPORT: &str = "report.json";
/// Name of the file that a running sweep holds locked.
const LOCK: &str = "lock";

/// Why a run cannot begin or go on in a directory.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Another run is at it.
    #[error("{0} is in use by another run; wait for it, or give another directory")]
    InUse(PathBuf),
    /// An earlier run was interrupted there.
    #[error("{0} holds an unfinished run; --resume goes on with it, or give another directory")]
    Unfinished(PathBuf),
    /// The unfinished run is another one.
    #[error(
        "{place} holds an unfinished run of something else: {difference}; give another directory"
    )]
    Other {
        /// The directory.
        place: PathBuf,
        /// What is different.
        difference: String,
    },
    /// A file cannot be read or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// Cells that no tile holds, or two: a mistake in topple.
    #[error("the tiles of the run do not hold every cell once")]
    Incomplete,
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl StoreError {
    fn file(path: &Path) -> impl Fn(io::Error) -> StoreError + '_ {
        |reason| StoreError::File { path: path.to_path_buf(), reason }
    }
}

/// What an earlier run left.
#[derive(Debug, Default)]
pub struct Found {
    /// Its whole tiles.
    pub tiles: Vec<Tile>,
    /// Files that are no whole tiles, and are run again: each with what is wrong.
    pub broken: Vec<(PathBuf, &'static str)>,
}

/// A sweep's folder, locked for as long as it lives.
#[derive(Debug)]
pub struct Store {
    folder: Directory,
    path: PathBuf,
    lock: File,
    identity: Identity,
}

impl Store {
    /// Opens the folder in `out` for a run; with `resume` goes on with what an earlier one left.
    ///
    /// # Errors
    /// [`StoreError`]: another run is there, or an unfinished one that is not to be resumed or is not
    /// this one.
    pub fn open(
        out: &Path,
        identity: Identity,
        resume: bool,
    ) -> Result<(Store, Found), StoreError> {
        let (path, place) = match identity.part() {
            None => (out.join(FOLDER), out.to_path_buf()),
            Some(part) => (out.join(part.folder()), out.join(part.folder())),
        };
        let folder = Directory::open(&path)?;
        let lock = lock(&path, &place)?;
        // Nobody else is writing there: the lock is held.
        folder.remove_leftovers()?;
        if place != path {
            Directory::open(&place)?.remove_leftovers()?;
        }
        let store = Store { folder, path, lock, identity };
        let before = store.path.join(IDENTITY);
        if !before.exists() {
            return Ok((store, Found::default()));
        }
        if !resume {
            return Err(StoreError::Unfinished(place));
        }
        let text = fs::read_to_string(&before).map_err(StoreError::file(&before))?;
        if let Some(difference) = store.identity.difference(&text) {
            return Err(StoreError::Other { place, difference });
        }
        let found = Found::in_folder(&store.path, store.identity.tag(), &|_| ())?;
        for (path, _) in &found.broken {
            fs::remove_file(path).map_err(StoreError::file(path))?;
        }
        Ok((store, found))
    }

    /// Keeps the outcomes of cells from `first` on: they are on disk, whole, when this returns.
    ///
    /// # Errors
    /// [`StoreError::Write`], with nothing left behind.
    pub fn keep(&self, first: usize, outcomes: &[Outcome]) -> Result<Tile, StoreError> {
        if !self.path.join(IDENTITY).exists() {
            self.folder.write(IDENTITY, |w| w.write_all(self.identity.text().as_bytes()))?;
        }
        let bytes = tile::to_bytes(first, outcomes, self.identity.tag());
        let path = self.folder.write(&tile::name(first), |w| w.write_all(&bytes))?;
        Ok(Tile { path, cells: first..first + outcomes.len() })
    }

    /// Says that all of a part is there, and how it was run; of a part that was finished before, the
    /// report is left as it was. The part's folder.
    ///
    /// # Errors
    /// [`StoreError::Write`], with nothing left behind.
    pub fn finish(self, report: &Report) -> Result<PathBuf, StoreError> {
        if report.resumed_cells == report.cells && self.path.join(REPORT).exists() {
            return Ok(self.path);
        }
        self.folder.write(REPORT, |w| serde_json::to_writer_pretty(w, report))?;
        Ok(self.path)
    }

    /// Removes the folder: its run is finished, or left nothing to go on with.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard(self) -> Result<(), StoreError> {
        let Store { path, lock, .. } = self;
        // An open file cannot be removed everywhere.
        drop(lock);
        fs::remove_dir_all(&path).map_err(StoreError::file(&path))
    }

    /// Removes the folder if nothing was kept in it; true if something was.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard_if_empty(self) -> Result<bool, StoreError> {
        if self.path.join(IDENTITY).exists() {
            return Ok(true);
        }
        self.discard().map(|()| false)
    }
}

impl Found {
    /// The tiles of an identity's tag in a folder; `seen` hears of the cells of each.
    fn in_folder(folder: &Path, tag: u32, seen: &dyn Fn(usize)) -> Result<Found, StoreError> {
        let mut paths = Vec::new();
        for entry in fs::read_dir(folder).map_err(StoreError::file(folder))? {
            let path = entry.map_err(StoreError::file(folder))?.path();
            if path.extension().is_some_and(|extension| extension == tile::EXTENSION) {
                paths.push(path);
            }
        }
        paths.sort();
        let mut found = Found::default();
        for path in paths {
            match tile::find(&path, tag).map_err(StoreError::file(&path))? {
                Ok(tile) => {
                    seen(tile.cells.len());
                    found.tiles.push(tile);
                }
                Err(reason) => found.broken.push((path, reason)),
            }
        }
        Ok(found)
    }
}

/// Times that a lock is asked for. A child of this process that is just being started holds what this
/// process held until it runs its own program: an instant.
const ATTEMPTS: u32 = 10;
/// Pause between them.
const PAUSE: Duration = Duration::from_millis(20);

/// Locks a folder; `place` is what the user knows it by.
fn lock(folder: &Path, place: &Path) -> Result<File, StoreError> {
    let path = folder.join(LOCK);
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
