//! How a suite is swept.

use std::path::PathBuf;

use topple::results::columns::Column;
use topple::results::shard::Shard;
use topple::sweep::settings::RunSettings;

/// How a suite is swept.
#[derive(Debug, Clone, Default)]
pub struct SuiteSettings {
    /// How each sweep is run; its verification is of all of them together.
    pub run: RunSettings,
    /// The directory in which each motion is saved when it is done; nowhere without it.
    pub saving: Option<PathBuf>,
    /// Run the k-th of n shards of the motions only, and leave them there.
    pub shard: Option<Shard>,
    /// Columns of a map that are kept beside outcome, strokes and rocking index.
    pub others: Vec<Column>,
}
