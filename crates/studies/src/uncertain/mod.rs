//! Numbers that are not known: how they are distributed, points that fill their distributions evenly, scenes at these
//! points, and how much of a result each number explains.
//!
//! ```text
//! distributions -> points -> scenes -> (sweeps) -> probabilities
//!               -> Saltelli's design -> outputs -> Sobol indices
//! ```

pub mod distribution;
pub(crate) mod ensemble;
pub(crate) mod indices;
pub mod normal;
pub(crate) mod pixel;
pub(crate) mod points;
pub mod probability;
pub(crate) mod varied;

pub use distribution::Distribution;
pub use ensemble::Ensemble;
pub use indices::{Bootstrap, Design, Index, indices};
pub use probability::{Probabilities, Uncertainty};
pub use varied::Varied;
