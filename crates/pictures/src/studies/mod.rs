//! Pictures of studies: a suite's spectra, an envelope, a fragility, a probability.

pub mod comparison;
pub mod envelope;
pub mod envelope_curves;
pub mod fragility;
pub mod probability;
pub(crate) mod shades;
pub mod suite;
