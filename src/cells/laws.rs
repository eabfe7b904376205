//! The laws of the base that decide which model a cell runs.

use super::shortcuts::Shortcuts;
use crate::scene::device::Pressure;
use crate::scene::isolation::Isolation;

/// The laws that decide which model a cell runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Laws {
    /// Whether the base moves in each direction.
    pub(crate) moves: [bool; 2],
    /// The base yields.
    pub(crate) yields: bool,
    /// n of (11).
    pub(crate) bouc_wen_n: u32,
    /// The force of the base's pendulum follows the pressure.
    pub(crate) follows: bool,
    /// The base has an end stop.
    pub(crate) stops: bool,
    /// The vertical spring hardens.
    pub(crate) hardens: bool,
}

impl Laws {
    /// The laws of a base.
    pub(crate) fn of(base: &Isolation, shortcuts: Shortcuts) -> Laws {
        let law = base.horizontal;
        Laws {
            moves: [law.is_some(), base.vertical.is_some()],
            yields: law.is_some_and(|law| shortcuts.integrate_z(law.psi)),
            bouc_wen_n: law.map_or(2, |law| law.n),
            follows: law.is_some_and(|law| law.pressure == Some(Pressure::Follows)),
            stops: law.is_some() && base.stop.is_some(),
            hardens: base.vertical.is_some_and(|law| law.hardening.is_some()),
        }
    }

    /// The laws of a block on the ground.
    pub(crate) const GROUND: Laws = Laws {
        moves: [false; 2],
        yields: false,
        bouc_wen_n: 2,
        follows: false,
        stops: false,
        hardens: false,
    };

    /// The same with the horizontal direction locked.
    pub(crate) fn without_horizontal(self) -> Laws {
        let moves = [false, self.moves[1]];
        Laws { moves, yields: false, follows: false, stops: false, ..self }
    }

    /// The same with the vertical direction locked.
    pub(crate) fn without_vertical(self) -> Laws {
        Laws { moves: [self.moves[0], false], hardens: false, ..self }
    }

    /// True where the motions in full contact may be shared, with the bounds of the base of the paper.
    pub(crate) fn shares_contact(self) -> bool {
        !(self.follows || self.stops || self.hardens)
    }
}
