//! Why a list of devices makes no comparison.

use topple::scene::shown::shown;
use topple::sweep::error::SweepError;

/// The fault of a list of devices, and its place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}{}: {problem}", place(.column))]
pub struct DevicesError {
    /// The line of the list, from 1.
    pub line: u64,
    /// The column, where one of the list is at fault.
    pub column: Option<String>,
    /// The fault and the remedy; keys of a scene stand in backquotes.
    pub problem: String,
}

fn place(column: &Option<String>) -> String {
    column.as_ref().map_or(String::new(), |column| format!(", column {}", shown(column)))
}

/// Why devices are not compared.
#[derive(Debug, thiserror::Error)]
pub enum ComparisonError {
    /// A device makes no scene.
    #[error(transparent)]
    Devices(#[from] DevicesError),
    /// An invalid setting, or a sweep that failed.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}
