//! Suites: sets of records that belong to one question, such as those that represent a site.
//!
//! ```text
//! files (a folder, a zip, a list) -> entries (which belong together) -> motions -> measures -> table, picture
//! ```

pub mod entry;
pub mod envelope;
#[cfg(feature = "pictures")]
pub mod envelope_picture;
pub mod error;
mod files;
mod list;
pub mod measures;
mod names;
mod peer;
#[cfg(feature = "pictures")]
pub mod picture;
pub mod read;
pub mod spectrum;
pub mod swept;
pub mod table;

pub use entry::{Entry, Motion};
pub use error::SuiteError;
pub use read::Suite;
