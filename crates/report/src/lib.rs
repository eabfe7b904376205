//! Reports of runs: what was asked, what was found, how far it was checked and what it leaves out, for who decides and reads no
//! code. All of it comes from the files of the runs.
//!
//! ```text
//! folder -> document -> tables -> block -> fragility -> findings -> summary -> contents -> html, print -> file
//! ```

mod along;
pub mod block;
mod contents;
pub mod document;
mod file;
mod findings;
mod folder;
pub mod fragility;
pub mod html;
mod print;
pub mod summary;
mod tables;

pub use file::write;
use folder::Folder;
pub use folder::ReportError;

/// What a report says of itself; a file without it is no report.
const CREATOR: &str = "topple report";
