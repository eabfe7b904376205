//! A scene at one place of its grid: the numbers that a thread gets, and its first state.
//!
//! ```text
//! laws, clock_parts, groups, reader, cache, samples -> plan, cell_list -> part -> table, cell_tables -> begin, contact -> ready
//! ```

pub(crate) mod at_rest;
pub(crate) mod begin;
pub(crate) mod body;
pub(crate) mod bounds;
pub(crate) mod cache;
pub mod cell_list;
pub mod cell_tables;
pub mod clock;
pub(crate) mod clock_parts;
pub(crate) mod coefficients;
pub mod contact;
pub mod groups;
pub(crate) mod laws;
pub(crate) mod listing;
pub mod part;
pub mod plan;
pub(crate) mod reader;
pub mod ready;
pub(crate) mod samples;
pub mod shortcuts;
pub(crate) mod table;
pub(crate) mod window;
