//! Refined maps: a sweep's cells halved again and again where something changes from one to the next, so that a
//! picture of 8192 x 8192 cells takes a small share of the cells.
//!
//! ```text
//! map -> boxes whose corners differ -> their cells -> islands -> probes -> the next level
//! ```
//!
//! The finest grid has the values of the map's axes with every gap halved as many times as there are levels. A box lies
//! between neighbouring cells of a level; one whose cells differ in outcome or impacts is split into four, down to the
//! finest grid. What is left alone has one outcome at all of its cells that were run, and this is taken for the others
//! in it. An island that lies between these cells is missed: cells in it are drawn at random and run, and tell how
//! large the share missed can be.

pub(crate) mod bound;
pub(crate) mod boxes;
pub mod codes;
pub(crate) mod error;
pub(crate) mod leaves;
pub(crate) mod probes;
pub mod refined;
mod refiner;
pub mod report;
pub mod run;
pub mod settings;
pub(crate) mod smooth;
