//! Integration in time: the fixed-step method of the sweeps, and the adaptive reference.

pub mod certificate;
pub mod lanes;
pub mod locate;
pub mod log;
pub mod outcome;
pub mod reference;
pub mod rk4;
pub mod state;
pub mod switching;
