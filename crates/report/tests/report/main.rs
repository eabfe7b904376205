//! The tests of reports, by the file that they test.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod block;
mod fragility;
mod html;
mod summary;
