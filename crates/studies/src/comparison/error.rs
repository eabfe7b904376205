//! Why devices are not compared.

use crate::sheet::TableError;
use topple::sweep::error::SweepError;

/// Why devices are not compared.
#[derive(Debug, thiserror::Error)]
pub enum ComparisonError {
    /// A device makes no scene.
    #[error(transparent)]
    Devices(#[from] TableError),
    /// An invalid setting, or a sweep that failed.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}
