//! Numbers that are not known: how they are distributed, points that fill their distributions evenly, scenes at these
//! points, and how much of a result each number explains.
//!
//! ```text
//! distributions -> points -> scenes -> (sweeps) -> probabilities
//!               -> Saltelli's design -> outputs -> Sobol indices
//! ```

pub(crate) mod ensemble;
pub(crate) mod indices;
pub(crate) mod pixel;
pub(crate) mod points;
pub mod probability;
pub(crate) mod varied;

pub use ensemble::Ensemble;
pub use indices::{Design, Index, indices};
pub use probability::{Probabilities, Uncertainty};
pub use varied::Varied;
