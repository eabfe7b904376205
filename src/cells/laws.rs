//! The laws of the base that decide which model a cell runs.

use super::shortcuts::Shortcuts;
use crate::scene::isolation::Isolation;

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

impl Laws {
    /// Those of a base.
    pub(crate) fn of(base: &Isolation, shortcuts: Shortcuts) -> Laws {
        let law = base.horizontal;
        Laws {
            moves: [law.is_some(), base.vertical.is_some()],
            yields: law.is_some_and(|law| shortcuts.integrate_z(law.psi)),
            bouc_wen_n: law.map_or(2, |law| law.n),
        }
    }
}
