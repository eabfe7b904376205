//! The tests of the page's library, by the file that they test, and of what it exports.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod about;
mod asked;
mod body;
mod dropped;
mod export;
mod exported;
mod frame;
mod guard;
mod page;
mod ranges;
mod records;
mod refused;
mod room;
mod stages;
mod suites;
mod watched;
