//! The tests of the page's library.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod exported;
