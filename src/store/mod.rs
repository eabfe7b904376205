//! A sweep on disk while it runs: what is done is kept, so that an interrupted run goes on from there.
//!
//! `DIR/unfinished` holds the run's [`Identity`], a lock, and tiles: runs of cells, each a file of its
//! own that appears whole or not at all. When the map is written the folder goes.

pub mod identity;
pub mod tile;

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::integrate::outcome::Outcome;
use crate::map::files::{Directory, WriteError};
use identity::Identity;
use tile::Tile;

/// Name of the folder in a run's directory.
const FOLDER: &str = "unfinished";
/// Name of the identity's file.
const IDENTITY: &str = "identity.json";
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
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// What an earlier run left.
#[derive(Debug, Default)]
pub struct Found {
    /// Its whole tiles.
    pub tiles: Vec<Tile>,
    /// Files that are no whole tiles, and are run again: each with what is wrong.
    pub broken: Vec<String>,
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
        let path = out.join(FOLDER);
        let folder = Directory::open(&path)?;
        let lock_path = path.join(LOCK);
        let failed = |path: &Path, reason| StoreError::File { path: path.to_path_buf(), reason };
        let lock = File::create(&lock_path).map_err(|e| failed(&lock_path, e))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(StoreError::InUse(out.to_path_buf())),
            Err(TryLockError::Error(reason)) => return Err(failed(&lock_path, reason)),
        }
        // Nobody else is writing here: the lock is held.
        Directory::open(out)?.remove_leftovers()?;
        let store = Store { folder, path, lock, identity };
        let before = store.path.join(IDENTITY);
        let mut found = Found::default();
        if before.exists() {
            if !resume {
                return Err(StoreError::Unfinished(out.to_path_buf()));
            }
            let text = fs::read_to_string(&before).map_err(|e| failed(&before, e))?;
            if let Some(difference) = store.identity.difference(&text) {
                let place = out.to_path_buf();
                return Err(StoreError::Other { place, difference });
            }
            found = store.read()?;
        }
        Ok((store, found))
    }

    /// Reads the tiles that are there; removes what is none.
    fn read(&self) -> Result<Found, StoreError> {
        let failed = |path: &Path, reason| StoreError::File { path: path.to_path_buf(), reason };
        let mut paths = Vec::new();
        for entry in fs::read_dir(&self.path).map_err(|e| failed(&self.path, e))? {
            let path = entry.map_err(|e| failed(&self.path, e))?.path();
            if path.extension().is_some_and(|extension| extension == tile::EXTENSION) {
                paths.push(path);
            }
        }
        paths.sort();
        let mut found = Found::default();
        for path in paths {
            let bytes = fs::read(&path).map_err(|e| failed(&path, e))?;
            match Tile::from_bytes(&bytes, self.identity.tag()) {
                Ok(tile) => found.tiles.push(tile),
                Err(reason) => {
                    fs::remove_file(&path).map_err(|e| failed(&path, e))?;
                    found.broken.push(format!("{}: {reason}", path.display()));
                }
            }
        }
        Ok(found)
    }

    /// Keeps the outcomes of cells from `first` on: they are on disk, whole, when this returns.
    ///
    /// # Errors
    /// [`StoreError::Write`], with nothing left behind.
    pub fn keep(&self, first: usize, outcomes: &[Outcome]) -> Result<(), StoreError> {
        if !self.path.join(IDENTITY).exists() {
            self.folder.write(IDENTITY, |w| w.write_all(self.identity.text().as_bytes()))?;
        }
        let bytes = tile::to_bytes(first, outcomes, self.identity.tag());
        self.folder.write(&tile::name(first), |w| w.write_all(&bytes))?;
        Ok(())
    }

    /// Removes the folder: its run is finished, or left nothing to go on with.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard(self) -> Result<(), StoreError> {
        let Store { path, lock, .. } = self;
        // An open file cannot be removed everywhere.
        drop(lock);
        fs::remove_dir_all(&path).map_err(|reason| StoreError::File { path, reason })
    }

    /// Removes the folder if nothing was kept in it.
    ///
    /// # Errors
    /// [`StoreError::File`].
    pub fn discard_if_empty(self) -> Result<(), StoreError> {
        if self.path.join(IDENTITY).exists() { Ok(()) } else { self.discard() }
    }
}

/// The runs of cells from 0 to `count` that no tile holds.
pub fn missing(tiles: &[Tile], count: usize) -> Vec<Range<usize>> {
    let mut held: Vec<Range<usize>> = tiles.iter().map(Tile::cells).collect();
    held.sort_by_key(|cells| cells.start);
    let mut missing = Vec::new();
    let mut from = 0;
    for cells in held {
        if cells.start > from {
            missing.push(from..cells.start);
        }
        from = from.max(cells.end);
    }
    if from < count {
        missing.push(from..count);
    }
    missing
}
