//! Which feasible cell is the best.

use std::cmp::Reverse;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::{CellEnvelope, Envelope};
use topple::Written;

topple::written! {
    /// What makes a feasible cell better than another.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Best {
        /// It lies farther from a cell that fails; of equal ones the least max |u|, then the least stroke of v.
        Reserve = "reserve",
        /// A smaller largest max |u|; of equal ones the least stroke of v. Cells that have no feasible one beside them come last.
        StrokeU = "stroke_u" | "stroke-u",
        /// A smaller largest stroke of v; of equal ones the least max |u|. Cells that have no feasible one beside them come last.
        StrokeV = "stroke_v" | "stroke-v",
    }
}

impl Default for Best {
    fn default() -> Best {
        Best::ALL[0]
    }
}

impl Best {
    /// What is meant by it, in words.
    pub fn words(self) -> &'static str {
        match self {
            Best::Reserve => {
                "the most steps of the grid from a cell that fails, then the least |u|"
            }
            Best::StrokeU => "the least |u|, then the least stroke of v",
            Best::StrokeV => "the least stroke of v, then the least |u|",
        }
    }
}

impl fmt::Display for Best {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

impl Envelope {
    /// The feasible cells, the best first.
    pub fn best(&self) -> Vec<usize> {
        let mut best: Vec<usize> =
            (0..self.cells.len()).filter(|cell| self.cells[*cell].feasible).collect();
        best.sort_by_cached_key(|cell| {
            let CellEnvelope { max_u, stroke_v, reserve, .. } = &self.cells[*cell];
            // Strokes are not negative: their bits sort as they do.
            let [u, v] = [max_u, stroke_v].map(|stroke| stroke[2].to_bits());
            let alone = self.is_alone(*cell);
            match self.settings.best {
                Best::Reserve => (false, Reverse(reserve.unwrap_or(u32::MAX)), u, v),
                Best::StrokeU => (alone, Reverse(0), u, v),
                Best::StrokeV => (alone, Reverse(0), v, u),
            }
        });
        best
    }

    /// True of a feasible cell that has neighbours, none of them feasible: a small change of the base is too much.
    pub fn is_alone(&self, cell: usize) -> bool {
        let grid = &self.sweep.grid;
        let place = grid.place(cell);
        let mut neighbours = Vec::new();
        for (axis, along) in grid.axes().iter().enumerate() {
            for at in [place[axis].checked_sub(1), Some(place[axis] + 1)].into_iter().flatten() {
                let mut beside = place;
                beside[axis] = at;
                neighbours.extend((at < along.count()).then(|| grid.cell(&beside)));
            }
        }
        !neighbours.is_empty() && !neighbours.iter().any(|cell| self.cells[*cell].feasible)
    }

    /// The axes at an end of which a cell lies: what is beyond is not known.
    pub fn at_ends(&self, cell: usize) -> Vec<&'static str> {
        let grid = &self.sweep.grid;
        let place = grid.place(cell);
        let axes = grid.axes().iter().enumerate().filter(|(_, axis)| axis.count() > 1);
        axes.filter(|(at, axis)| place[*at] == 0 || place[*at] + 1 == axis.count())
            .map(|(_, axis)| axis.key())
            .collect()
    }
}
