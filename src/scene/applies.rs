//! Beside which choices of a scene a number means something: a column of the parameter table. What a scene refuses, what
//! the page hides and what the page's own engine refuses is read from it; in the page by
//! `crates/explore/src/page/choices.js`. What is refused, here and there: `crates/explore/tests/explore/exported.rs`.

use serde::Serialize;

use super::directions::Directions;
use crate::model::pulse::Shape;

/// Where the numbers of the block come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BlockBy {
    /// The scene gives them.
    Numbers,
    /// It is an object of Table 1.
    Object,
}

/// The excitation of the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShakenBy {
    /// A pulse.
    Pulse,
    /// A record, or each of a suite of records.
    Record,
}

/// A choice of a scene beside which some numbers mean nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// The block.
    Block(BlockBy),
    /// The directions in which the base moves.
    Isolation(Directions),
    /// What shakes it.
    Excitation(ShakenBy),
    /// The shape of a pulse.
    Shape(Shape),
}

/// The choices beside which a number means something: of each kind those that are listed, or any where none is. In JSON
/// the kinds with a list alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Applies {
    /// Blocks.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub block: &'static [BlockBy],
    /// Directions in which the base moves.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub isolation: &'static [Directions],
    /// The excitation of the base.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub excitation: &'static [ShakenBy],
    /// Shapes of a pulse.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub shape: &'static [Shape],
}

impl Applies {
    /// Beside any choices.
    pub const ALWAYS: Applies = Applies { block: &[], isolation: &[], excitation: &[], shape: &[] };

    /// True where the number means something beside a choice.
    pub fn beside(&self, choice: Choice) -> bool {
        fn holds<T: PartialEq>(listed: &[T], chosen: T) -> bool {
            listed.is_empty() || listed.contains(&chosen)
        }
        match choice {
            Choice::Block(block) => holds(self.block, block),
            Choice::Isolation(directions) => holds(self.isolation, directions),
            Choice::Excitation(excitation) => holds(self.excitation, excitation),
            Choice::Shape(shape) => holds(self.shape, shape),
        }
    }
}
