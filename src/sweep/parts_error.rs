//! Why parts are no map.

use std::path::PathBuf;

use crate::results::store_error::StoreError;

/// Why parts are no map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PartsError {
    /// A directory without parts.
    #[error("{0} holds no part; give directories that runs of parts were given")]
    None(PathBuf),
    /// A part that is not finished.
    #[error("{place} is unfinished, {cells} are missing; run it again with `resume`")]
    Unfinished {
        /// The part's folder.
        place: PathBuf,
        /// The first that are missing.
        cells: String,
    },
    /// A part with a tile that is not whole.
    #[error("{place}: {reason}; run its part again with `resume`")]
    Broken {
        /// The tile's file.
        place: PathBuf,
        /// What is wrong.
        reason: &'static str,
    },
    /// A part of something else.
    #[error("{place} is no part of the same map as {first}: {difference}")]
    Other {
        /// The part's folder.
        place: PathBuf,
        /// The first part's folder.
        first: PathBuf,
        /// What is different.
        difference: String,
    },
    /// Cells in two parts.
    #[error("{one} and {other} overlap, both hold {cells}; leave one out")]
    Overlap {
        /// A part's folder.
        one: PathBuf,
        /// Another's.
        other: PathBuf,
        /// The cells.
        cells: String,
    },
    /// Cells in no part.
    #[error("no part holds {cells}; {hint}")]
    Gap {
        /// The cells.
        cells: String,
        /// Which part may be missing.
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
