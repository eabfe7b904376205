//! A scene at one place of its grid: the numbers that a thread gets, and its first state.
//!
//! ```text
//! plan, groups, laws, clock -> table, cell_tables -> begin, contact -> ready -> reader
//! ```

pub(crate) mod at_rest;
pub mod begin;
pub mod body;
pub(crate) mod bounds;
pub mod cell_tables;
pub mod clock;
pub(crate) mod clock_parts;
pub(crate) mod coefficients;
pub mod contact;
pub mod groups;
pub(crate) mod laws;
pub mod listing;
pub mod plan;
pub mod prepare;
pub mod reader;
pub mod ready;
pub mod shortcuts;
pub mod table;
pub mod window;
