//! The directions in which a base moves.

use serde::{Deserialize, Serialize};

use crate::written;

written! {
    /// The directions in which the base moves.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Directions {
        /// Horizontally and vertically.
        Dual = "dual",
        /// Horizontally only.
        Horizontal = "horizontal",
        /// Vertically only.
        Vertical = "vertical",
        /// The block stands on the ground.
        None = "none",
    }
}

/// The bases that move horizontally.
pub const MOVES_H: &[Directions] = &[Directions::Dual, Directions::Horizontal];
/// Those that move vertically.
pub const MOVES_V: &[Directions] = &[Directions::Dual, Directions::Vertical];

impl Directions {
    /// True where the base moves horizontally.
    pub fn moves_h(self) -> bool {
        MOVES_H.contains(&self)
    }

    /// True where it moves vertically.
    pub fn moves_v(self) -> bool {
        MOVES_V.contains(&self)
    }

    /// The same with the horizontal direction locked.
    pub fn without_horizontal(self) -> Directions {
        if self.moves_v() { Directions::Vertical } else { Directions::None }
    }

    /// The same with the vertical direction locked.
    pub fn without_vertical(self) -> Directions {
        if self.moves_h() { Directions::Horizontal } else { Directions::None }
    }
}
