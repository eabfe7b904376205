//! The pictures of a map, and of one cell's motion.

pub mod curves;
pub mod field;
pub mod fields;
pub mod greys;
pub mod history;
pub mod islands;
pub mod keys;
pub mod labels;
pub mod layout;
pub mod main;
pub mod overlay;
pub mod overturning;
