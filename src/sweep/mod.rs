//! A scene over its grid: batches of cells, saving, shards, repair, and the check against the reference.
//!
//! ```text
//! run -> job -> runner -> batches -> backend -> outcomes -> map -> verification
//! ```

pub mod batches;
pub mod error;
pub mod estimate;
pub mod identity;
pub mod job;
pub(crate) mod list;
pub mod map;
pub mod motion_of_cell;
pub mod points;
pub(crate) mod repair;
pub mod repaired;
pub mod run;
pub(crate) mod runner;
pub mod sample;
pub mod settings;
pub mod shards;
pub(crate) mod shards_error;
pub mod verdict;
pub mod verification;
