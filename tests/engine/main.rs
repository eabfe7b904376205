//! The tests of the engine, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../common/mod.rs"]
mod common;

mod asked;
mod axes;
mod begin;
mod columns;
mod contradictions;
mod devices;
mod extremes;
mod free_standing;
mod interrupted;
mod lanes;
mod lists;
mod long_steps;
mod malformed;
mod manifest;
mod physics;
mod pulses;
mod random;
mod records;
mod reference;
mod refined;
mod repair;
mod run;
mod seismic;
mod shader;
mod shards;
mod shortcuts;
mod stated_columns;
mod tiles;
#[path = "../../benches/warps/tests.rs"]
mod warps;
mod written_records;
