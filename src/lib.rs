//! Overturning and rocking maps of rigid blocks on an isolated base.
//!
//! A [`Scene`](scene::Scene) says what is simulated; its [`Grid`](scene::Grid) names the cells,
//! each one simulation. A [backend](sweep) runs them, by the same fixed-step method on a GPU or a
//! CPU, and gives one [`Outcome`](stepping::outcome::Outcome) a cell; the adaptive
//! [reference](stepping::reference) judges a sample of them. The [map] of outcomes goes to
//! files.
//!
//! ```text
//! scene -> grid -> cells -> backend -> outcomes -> map -> files
//! ```

pub mod chart;
pub mod figures;
pub mod map;
pub mod model;
pub mod scene;
pub mod stepping;
pub mod store;
pub mod sweep;

/// The README's example, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
