//! Reports of runs: what was asked, what was found, how far it was checked and what it leaves out, for who decides and reads no
//! code. All of it comes from the files of the runs.
//!
//! ```text
//! folder -> document -> block -> findings -> contents -> html, print
//! ```

mod block;
mod contents;
mod document;
mod findings;
mod folder;
pub mod html;
pub mod print;

pub use contents::of;
pub use document::{Document, Piece};
pub use folder::{Folder, ReportError};

/// What a report says of itself; a file without it is no report.
pub const CREATOR: &str = "topple report";
