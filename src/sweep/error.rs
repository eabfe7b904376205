//! Why a sweep did not come to its end.

use std::io;
use std::path::{Path, PathBuf};

use super::shards_error::ShardsError;
use crate::backend::backend_error::BackendError;
use crate::results::store_error::StoreError;
use crate::scene::SceneError;

/// Why a sweep did not come to its end.
///
/// A message names the settings at fault by their keys, in backquotes where it stands in the text; a caller
/// with another way of naming them, such as a command line, puts its own in their place.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// An invalid number or setting.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// No backend, or one that failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The directory in which finished cells are to be saved cannot be used.
    #[error(transparent)]
    Folder(StoreError),
    /// Finished cells cannot be saved.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Shards that are no map.
    #[error(transparent)]
    Shards(#[from] ShardsError),
    /// Outcomes on disk that cannot be read any more.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// A run ended early, with work to go on from.
    #[error("{error}; {saved} of {cells} cells are saved in {folder}, `resume` goes on from there")]
    Stopped {
        /// Why.
        error: Box<SweepError>,
        /// Cells that are saved.
        saved: usize,
        /// Cells that were to run.
        cells: usize,
        /// Where they are.
        folder: PathBuf,
    },
}

impl SweepError {
    /// The key of the setting or the number at fault, of bad input; none for a run that failed. Of settings it is
    /// `step` ([`Method::largest_step`]), `adapter` ([`RunSettings::adapters`]), `out` ([`Saving::directory`])
    /// or `tile` ([`Saving::shard`]).
    ///
    /// [`Method::largest_step`]: super::settings::Method::largest_step
    /// [`RunSettings::adapters`]: super::settings::RunSettings::adapters
    /// [`Saving::directory`]: super::settings::Saving::directory
    /// [`Saving::shard`]: super::settings::Saving::shard
    pub fn key(&self) -> Option<&'static str> {
        match self {
            SweepError::Scene(error) => Some(error.key),
            SweepError::Backend(
                BackendError::NoSuchAdapter(_) | BackendError::Unlike(..) | BackendError::NoneOfCpu,
            ) => Some("adapter"),
            SweepError::Folder(_) => Some("out"),
            _ => None,
        }
    }

    /// The same of a run of which so many of its cells are saved in a folder; as it is where it says that already.
    pub fn stopped(self, saved: usize, cells: usize, folder: &Path) -> SweepError {
        if matches!(self, SweepError::Stopped { .. }) {
            return self;
        }
        let (error, folder) = (Box::new(self), folder.to_path_buf());
        SweepError::Stopped { error, saved, cells, folder }
    }

    /// True if the observer cancelled the sweep.
    pub fn is_cancelled(&self) -> bool {
        match self {
            SweepError::Backend(BackendError::Cancelled) => true,
            SweepError::Read(error) => error.kind() == io::ErrorKind::Interrupted,
            SweepError::Stopped { error, .. } => error.is_cancelled(),
            _ => false,
        }
    }
}
