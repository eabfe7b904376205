//! The paper, the chart and the methods: what reviewers run.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod agreement;
mod bisection;
mod chart {
    mod fit;
    mod table;
}
mod paper;
mod stability;
mod stored;
