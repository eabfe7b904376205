//! A scene over its grid: cells, backends, and the check against the reference.
//!
//! ```text
//! run -> job -> batches -> backend -> (cpu | gpu | the reference) -> outcomes -> map -> verification
//! ```

mod at_rest;
pub mod backend;
pub mod backend_error;
mod batch_watch;
pub mod batches;
pub mod begin;
pub mod body;
mod bounded_motions;
mod bounds;
pub mod cell_tables;
pub mod cells;
pub mod clock;
mod clock_parts;
mod coefficients;
pub mod cpu;
mod dependence;
pub mod description;
pub mod error;
pub mod estimate;
pub mod full_contact;
mod gap_steps;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod groups;
pub mod history;
pub mod identity;
pub mod job;
mod kept_motions;
pub mod lanes;
mod laws;
pub mod list;
pub mod listing;
pub mod map;
mod motion_cache;
pub mod motion_of_cell;
pub mod motions;
mod motions_with_forces;
pub mod observed;
pub mod observer;
mod order;
pub mod parts;
pub mod parts_error;
pub mod plan;
pub mod points;
pub mod prepare;
pub mod progress;
pub mod reader;
pub mod repair;
pub mod repaired;
pub mod report;
pub mod request;
pub mod run;
pub mod sample;
mod sampling;
pub mod settings;
pub mod several;
pub mod shared;
pub mod shared_contact;
mod shared_friction;
mod shared_motion;
pub mod shortcuts;
mod snapshots;
pub mod table;
pub mod threads;
pub mod vectors;
pub mod verdict;
pub mod verification;
pub mod window;
