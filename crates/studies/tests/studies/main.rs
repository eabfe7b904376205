//! The tests of the studies, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod estimators;
mod fits;
mod rates;
