//! Why a run cannot begin or go on in a directory.

use std::io;
use std::path::{Path, PathBuf};

use super::files::WriteError;

/// Why a run cannot begin or go on in a directory.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoreError {
    /// Another run is at it.
    #[error("{0} is in use by another run; wait for it, or give another directory")]
    InUse(PathBuf),
    /// An earlier run was interrupted there.
    #[error("{0} holds an unfinished run; `resume` goes on with it, or give another directory")]
    Unfinished(PathBuf),
    /// A shard is there, whole.
    #[error("{0} holds a finished shard; `resume` leaves it as it is, or give another directory")]
    Finished(PathBuf),
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
    /// A chunk is there that the unfinished run did not write.
    #[error("{0} is a chunk of another run; move it away, or give another directory")]
    NotOfThisRun(PathBuf),
    /// A file cannot be read or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// Cells that no chunk holds, or two: a mistake in topple.
    #[error("the chunks of the run do not hold every cell once")]
    Incomplete,
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl StoreError {
    /// Says of which file an error of the disk is.
    pub fn file(path: &Path) -> impl Fn(io::Error) -> StoreError + '_ {
        |reason| StoreError::File { path: path.to_path_buf(), reason }
    }
}
