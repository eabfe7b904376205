//! The tests of the studies, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../../../records/tests/common/told.rs"]
mod told;

mod comparison {
    mod devices;
}
mod estimators;
mod fits;
mod folders;
mod fragility {
    mod curve;
    mod curves;
    mod hazard;
    mod interval;
    mod newton;
}
mod levels;
mod rates;
mod sharpness;
mod sheet;
mod statistics {
    mod bca;
    mod bootstrap;
    mod distribution;
    mod normal;
    mod quantile;
    mod share;
}
mod suite_files;
mod suites;
mod texts;
mod uncertain;
