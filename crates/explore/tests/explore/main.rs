//! The tests of the page's server, by the file that they test.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod about;
mod asked;
mod body;
mod dropped;
mod export;
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
