//! A scene over its grid: cells, backends, and the check against the reference.

pub mod backend;
mod bounds;
pub mod cells;
pub mod choice;
pub mod clock;
pub mod coefficients;
pub mod cpu;
pub mod full_contact;
pub mod gpu;
pub mod history;
pub mod lanes;
pub mod plan;
pub mod shared;
pub mod tiles;
pub mod verification;
