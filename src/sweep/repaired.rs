//! What a repair did.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// How a map was repaired.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Repair {
    /// Cells that ran again: those beside a boundary.
    pub checked: usize,
    /// Cells that have another outcome since.
    pub changed: usize,
    /// Cells whose outcome no two of the three settings agree on; they are unresolved since.
    pub undecided: usize,
    /// Rounds: after the first one the neighbours of cells that changed run again.
    pub rounds: usize,
    /// Seconds that it took.
    pub seconds: f64,
    /// The cells that were replaced, in order.
    #[serde(skip)]
    pub replaced: Vec<usize>,
}

impl Repair {
    /// True where one of some cells was replaced.
    pub(crate) fn touches(&self, cells: &Range<usize>) -> bool {
        let next = self.replaced.partition_point(|cell| *cell < cells.start);
        self.replaced.get(next).is_some_and(|cell| *cell < cells.end)
    }
}
