//! The laws of the base that decide which model a cell runs.

/// The laws that decide which model a cell runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Laws {
    /// The base moves in each direction.
    pub(super) moves: [bool; 2],
    /// The base yields.
    pub(super) yields: bool,
    /// n of (11).
    pub(super) bouc_wen_n: u32,
}
