//! A scene over its grid: cells, backends, and the check against the reference.

pub mod cells;
pub mod cpu;
