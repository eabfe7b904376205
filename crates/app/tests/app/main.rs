//! The tests of the command, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../common/mod.rs"]
mod common;
#[path = "../../../records/tests/common/told.rs"]
mod told;

mod again;
mod beside;
mod chart;
mod columns;
mod command;
mod compare;
mod date;
mod devices;
mod docs_pictures;
mod drivers;
mod earlier_runs;
mod ending;
mod envelopes;
mod examples;
mod experiments;
mod explore;
mod exported_curves;
mod figures;
mod first_hour;
mod foreign;
mod fragility;
mod hazards;
mod histories;
mod interrupted;
mod malformed;
mod parameters;
mod paths;
mod pictures;
mod records;
mod refined;
mod remarks;
mod repair;
mod reports;
mod resampled;
mod said;
mod same_runs;
mod shards;
mod suite_files;
mod suites;
mod treatments;
mod uncertain;
mod words;
