//! Suites: sets of records that belong to one question, such as those that represent a site.
//!
//! ```text
//! files (a folder, a zip, a list) -> entries (which belong together) -> motions -> measures -> table, picture
//!   motions -> wanted (at which levels) -> swept, runner (sweeps; saved) -> envelope (shares; resample)
//! ```

pub mod columns;
pub(crate) mod entry;
pub mod envelope;
pub(crate) mod error;
pub(crate) mod estimate;
mod falling;
mod files;
mod found;
mod gather;
mod grouped;
pub mod intensity;
mod list;
pub mod measures;
pub mod names;
mod naming;
mod peer;
pub mod processing;
pub mod read;
mod recordings;
pub mod request;
pub mod resample;
mod run;
mod runner;
pub mod saved;
pub mod settings;
pub mod shown;
pub mod spectrum;
pub mod swept;
pub mod swept_motion;
pub mod table;
mod unused;
pub mod verified;
pub mod wanted;

pub use entry::{Entry, Motion};
pub use error::SuiteError;
pub use falling::Falling;
pub use found::Unused;
pub use read::Suite;
pub use request::SuiteRequest;
pub use resample::{Groups, Resample};
