//! Runs the same cells on the lanes of a CPU, on a device, or by the reference.
//!
//! ```text
//! request -> ready, cell_run -> (lanes | gpu | by_reference) -> sink
//! ```

pub mod backend_error;
pub mod by_reference;
pub mod cell_run;
pub mod cpu;
pub mod description;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod history;
pub mod lanes;
pub(crate) mod order;
pub mod ready;
pub mod report;
pub mod request;
pub mod sink;
