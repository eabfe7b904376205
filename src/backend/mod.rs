//! The same cells on lanes of a CPU, on a device, and by the reference.
//!
//! ```text
//! request -> dispatch, cell_run -> (lanes | gpu | by_reference) -> outcomes
//! ```

pub mod backend_error;
pub mod by_reference;
pub mod cell_run;
pub mod cpu;
pub mod description;
pub mod dispatch;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod history;
pub mod lanes;
pub(crate) mod order;
pub mod report;
pub mod request;
