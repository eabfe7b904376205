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
mod interrupted;
mod lanes;
mod lists;
mod long_steps;
mod malformed;
mod manifest;
mod pairs;
mod physics;
mod pulses;
mod random;
mod reference;
mod refined;
mod repair;
mod run;
mod seismic;
mod shader;
mod shards;
mod shortcuts;
mod tables;
mod tiles;
#[path = "../../benches/warps/tests.rs"]
mod warps;
mod written;
