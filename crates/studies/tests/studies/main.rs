//! The tests of the studies, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod estimators;
mod fits;
mod levels;
mod rates;
mod suite_files;
mod suites;
mod uncertain;
