//! The laws of the base that decide which model a cell runs.

/// The laws that decide which model a cell runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Laws {
    /// The base moves in each direction.
    pub(crate) moves: [bool; 2],
    /// The base yields.
    pub(crate) yields: bool,
    /// n of (11).
    pub(crate) bouc_wen_n: u32,
}
