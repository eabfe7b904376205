//! Why shards are no map.

use std::path::PathBuf;

use crate::results::chunk::Fault;
use crate::results::store_error::StoreError;

/// Why shards are no map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShardsError {
    /// A directory without shards.
    #[error("{0} holds no shard; give directories that runs of shards were given")]
    None(PathBuf),
    /// A shard that is not finished.
    #[error("{place} is unfinished, {cells} are missing; run it again with `resume`")]
    Unfinished {
        /// The shard's folder.
        place: PathBuf,
        /// The first that are missing.
        cells: String,
    },
    /// A shard with a chunk that is not whole.
    #[error("{place}: {reason}; run its shard again with `resume`")]
    Broken {
        /// The chunk's file.
        place: PathBuf,
        /// What is wrong.
        reason: Fault,
    },
    /// A chunk that the run of the shard's folder has not written.
    #[error("{place}: {reason}; give the folder as that run left it")]
    Foreign {
        /// The chunk's file.
        place: PathBuf,
        /// What it is.
        reason: Fault,
    },
    /// A part of something else.
    #[error("{place} is no part of the same map as {first}: {difference}")]
    Other {
        /// The shard's folder.
        place: PathBuf,
        /// The first shard's folder.
        first: PathBuf,
        /// What is different.
        difference: String,
    },
    /// Cells in two shards.
    #[error("{one} and {other} overlap, both hold {cells}; leave one out")]
    Overlap {
        /// A shard's folder.
        one: PathBuf,
        /// Another's.
        other: PathBuf,
        /// The cells.
        cells: String,
    },
    /// Cells in no shard.
    #[error("no shard holds {cells}; {hint}")]
    Gap {
        /// The cells.
        cells: String,
        /// Which shard may be missing.
        hint: String,
    },
    /// A file that cannot be read as what it should be.
    #[error("{place} cannot be read: {reason}")]
    Unreadable {
        /// The file.
        place: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A file that cannot be read at all.
    #[error(transparent)]
    Store(#[from] StoreError),
}
