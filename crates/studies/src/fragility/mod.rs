//! Fragility: the probability that a block fails as a function of the intensity, from runs of many records.
//!
//! ```text
//! levels (of an intensity measure) -> a suite's sweep -> suite_runs (runs of a cell, one per record), limit_state
//!   runs -> an estimator (stripes, IDA, cloud) -> a curve with theta and beta, or why there is none
//!        -> events or recordings resampled -> intervals
//!        hazard_text -> hazard curve -> annual rate, with what of it no data tell; order (curves that cross)
//!        -> sensitivity (numbers that are not known)
//!   -> study (all cells) -> tables, picture
//! ```

pub(crate) mod binary;
mod bisection;
pub(crate) mod capacity;
pub mod cloud;
mod curve;
pub mod estimate;
pub mod export;
pub mod fit;
pub mod hazard;
pub mod hazard_heading;
mod hazard_integrals;
mod hazard_openquake;
mod hazard_segment;
pub mod hazard_text;
pub mod ida;
pub mod interval;
pub mod levels;
pub mod limit_state;
pub(crate) mod link;
pub mod newton;
pub mod order;
pub mod profile;
pub mod rates;
pub mod request;
pub mod runs;
pub mod sensitivity;
pub mod stripes;
pub mod study;
pub(crate) mod suite_runs;
mod tables;

pub use capacity::{Capacity, share_that_stands_again};
pub use curve::{Curve, Lognormal};
pub use estimate::{Estimate, Estimator, Note, estimate};
pub use export::Export;
pub use fit::{Fit, Gap};
pub use hazard::{AnnualRate, HazardCurve, in_50_years};
pub use hazard_text::HazardText;
pub use rates::RateEstimate;
pub use request::{FragilityRequest, RUNS};
pub use runs::{RecordRuns, Run, Stripe};
