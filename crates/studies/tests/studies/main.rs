//! The tests of the studies, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod comparison {
    mod devices;
}
mod estimators;
mod fits;
mod fragility {
    mod curve;
    mod hazard;
    mod hazard_heading;
    mod hazard_text;
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
    mod distribution_text;
    mod normal;
    mod quantile;
    mod share;
}
mod suite_files;
mod suites;
mod uncertain;
