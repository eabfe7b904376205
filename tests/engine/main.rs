//! The tests of the engine, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../common/mod.rs"]
mod common;

mod asked;
mod axes;
mod begin;
mod columns;
mod devices;
mod extremes;
mod free_standing;
mod lanes;
mod lists;
mod long_steps;
mod manifest;
mod physics;
mod pulses;
mod random;
mod reference;
mod run;
mod seismic;
mod shader;
mod shortcuts;
mod tiles;
#[path = "../../benches/warps/tests.rs"]
mod warps;
