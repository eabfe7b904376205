//! A scene over its grid: cells, backends, and the check against the reference.

pub mod backend;
pub mod begin;
pub mod body;
mod bounds;
pub mod cell_tables;
pub mod cells;
pub mod choice;
pub mod clock;
mod clock_parts;
mod coefficients;
pub mod cpu;
pub mod full_contact;
pub mod gpu;
pub mod groups;
pub mod history;
pub mod lanes;
pub mod plan;
pub mod reader;
pub mod shared;
pub mod shared_contact;
mod shared_motion;
pub mod table;
pub mod tiles;
pub mod tracks;
pub mod verification;
