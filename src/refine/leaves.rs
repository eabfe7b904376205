//! The leaves of a refined map: what its files hold of it.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::boxes::Square;
use super::probes::own_cells;
use super::refined::RefinedMap;
use crate::results::columns::Column;
use crate::results::listed::{CountColumn, ListedCells};
use crate::results::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;

/// A leaf: cells of the finest grid that have one outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Leaf {
    /// The level of its box: 0 is between cells of the map that was refined.
    pub level: u32,
    /// Column of its first cell, which was run.
    pub column: usize,
    /// Row of its first cell.
    pub row: usize,
    /// Cells along the first axis.
    pub width: usize,
    /// Cells along the second axis.
    pub height: usize,
    /// A leaf beside it is smaller: a boundary is near, and a band thinner than a cell may cross it.
    pub beside: bool,
    /// Place of its first cell among those that were run.
    place: usize,
}

/// The leaves of a map, as outcomes: number k is that of the k-th leaf's first cell.
struct LeafOutcomes<'a> {
    map: &'a RefinedMap,
    leaves: &'a [Leaf],
}

impl Outcomes for LeafOutcomes<'_> {
    fn read(&self, leaves: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; leaves.len()];
        for (outcome, leaf) in outcomes.chunks_mut(1).zip(&self.leaves[leaves]) {
            self.map.block().read(leaf.place, columns, outcome);
        }
        Ok(Cow::Owned(outcomes))
    }
}

impl RefinedMap {
    /// The leaves, row by row of their first cells. Together they have every cell of the finest grid once.
    pub fn leaves(&self) -> Vec<Leaf> {
        let mut leaves = Vec::with_capacity(self.report.leaves);
        self.boxes.each_leaf(|square| self.add_leaf(square, &mut leaves));
        leaves.sort_unstable_by_key(|leaf| (leaf.row, leaf.column));
        leaves
    }

    /// Adds a leaf of the tree. One of the finest level at the far borders of the map has several cells, which were all
    /// run and may differ: each is a leaf.
    fn add_leaf(&self, square: Square, leaves: &mut Vec<Leaf>) {
        let (columns, rows) = own_cells(&self.boxes, square);
        let level = square.level;
        let beside = self.boxes.is_beside_smaller(square);
        let leaf = |column, row, width, height| {
            let place = self.place_of(row * self.boxes.shape().0 + column);
            Leaf { level, column, row, width, height, beside, place }
        };
        if level < self.boxes.levels() {
            leaves.push(leaf(columns.start, rows.start, columns.len(), rows.len()));
            return;
        }
        for row in rows {
            leaves.extend(columns.clone().map(|column| leaf(column, row, 1, 1)));
        }
    }

    /// Hands the leaves over as a list of cells, with the level, the width and the height of each.
    pub fn listed<T>(&self, see: impl FnOnce(&ListedCells) -> T) -> T {
        let leaves = self.leaves();
        let columns = self.report.shape.0;
        let cells: Vec<usize> =
            leaves.iter().map(|leaf| leaf.row * columns + leaf.column).collect();
        let count = |name, meaning, value: fn(&Leaf) -> usize| {
            // A side of the finest grid has fewer than 2^32 cells.
            let values = leaves.iter().map(|leaf| value(leaf) as u32).collect();
            CountColumn { name, meaning, values }
        };
        let counts = [
            count("level", "level of the leaf: 0 is between cells of the map", |leaf| {
                leaf.level as usize
            }),
            count(
                "width",
                "cells of the finest grid along the first axis, from this one on",
                |leaf| leaf.width,
            ),
            count(
                "height",
                "cells of the finest grid along the second axis, from this one on",
                |leaf| leaf.height,
            ),
            count(
                "beside",
                "1 where a leaf beside it is smaller: a boundary is near, and its cells that were not run are less sure",
                |leaf| usize::from(leaf.beside),
            ),
        ];
        let outcomes = LeafOutcomes { map: self, leaves: &leaves };
        let (grid, index) = (&self.grid, "leaf");
        see(&ListedCells { grid, cells: &cells, counts: &counts, outcomes: &outcomes, index })
    }
}
