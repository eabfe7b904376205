//! Pictures of studies: a suite's spectra, an envelope, a fragility, a hazard curve, a probability.

pub mod comparison;
pub mod envelope;
pub mod envelope_curves;
pub mod fragility;
pub mod hazard;
pub mod probability;
pub(crate) mod shades;
pub mod suite;
