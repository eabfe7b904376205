//! Fragility: the probability that a block fails as a function of the intensity, from runs of many records.
//!
//! ```text
//! runs -> an estimator (stripes, IDA, cloud) -> theta and beta, or why there are none
//!      -> records resampled -> intervals        hazard curve -> annual rate
//! ```
//!
//! These are functions of numbers: they know nothing of blocks or files.

pub mod binary;
pub mod capacity;
pub mod cloud;
pub mod fit;
pub mod ida;
pub mod link;
pub mod newton;
pub mod normal;
pub mod runs;
pub mod stripes;

