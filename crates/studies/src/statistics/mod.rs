//! Rules of statistics, each defined once for the studies, the pictures and the lab.
//!
//! Phi and what follows from it stand on `erfc` of the crate `libm`. The crate `statrs` 0.19 was compared: its Phi is off
//! by up to 9e-11 of its value where this one is exact to 1e-12, it has neither ln Phi nor the inverse Mills ratio, and
//! its quantile is as exact as this one but has another last digit in three of four shares, which would move every
//! point that is drawn of a normal distribution. Its quantiles of values are those of type 8 alone.

pub mod bca;
pub mod bootstrap;
pub mod distribution;
mod distribution_error;
mod distribution_text;
pub mod normal;
pub mod quantile;
pub mod share;

pub use bootstrap::Bootstrap;
pub use distribution::Distribution;
pub use distribution_error::DistributionError;
pub use share::DrawnGroups;
