//! Pictures of what topple computes, as SVG and PNG: maps, motions, suites, fragilities, probabilities.
//!
//! ```text
//! drawing -> map -> studies
//! ```

pub mod drawing;
pub mod map;
pub mod studies;
