//! Pictures of what topple computes, as SVG and PNG: maps, motions, suites, fragilities, probabilities.
//!
//! ```text
//! colours -> drawing -> map -> studies
//! ```

pub mod colours;
pub mod drawing;
pub mod map;
pub mod studies;
