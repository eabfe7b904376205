//! The pictures of a map, and of one cell's motion.

pub(crate) mod curves;
pub mod field;
pub mod fields;
pub mod greys;
pub mod history;
pub(crate) mod islands;
pub mod keys;
pub(crate) mod labels;
pub mod layout;
pub mod main;
pub mod overlay;
pub mod overturning;
pub(crate) mod single;
pub mod spectra;
