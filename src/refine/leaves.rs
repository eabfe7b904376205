//! The leaves of a refined map: the form in which files hold it.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::boxes::Square;
use super::probes::own_cells;
use super::refined::RefinedMap;
use crate::results::columns::Column;
use crate::results::listed::{self, CellList, CountColumn, FileCells};
use crate::results::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;
use crate::work::parallel;

/// The columns that tell how a block overturned.
const COUNTS: [Column; 3] = [Column::Outcome, Column::Impacts, Column::Uplifts];

/// A leaf: cells of the finest grid that have one outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Leaf {
    /// The level of its box: 0 is between cells of the map that was refined.
    pub level: u32,
    /// Column of its first cell, which was run.
    pub column: usize,
    /// Row of its first cell.
    pub row: usize,
    /// The number of cells along the first axis.
    pub width: usize,
    /// The number of cells along the second axis.
    pub height: usize,
    /// True where a leaf beside this one is smaller: a boundary is near, and a band that is thinner than a cell may cross this leaf.
    pub beside: bool,
    /// Its corners overturn after different numbers of impacts, 10 or more, which are not told apart: between two
    /// numbers blocks may rock on, in a band that may be thinner than a cell.
    pub impacts_differ: bool,
    /// The place of its first cell among the cells that were run.
    place: usize,
}

/// The leaves of a map as outcomes: outcome number k is that of the first cell of the k-th leaf.
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

impl Leaf {
    /// True where the cells of the leaf that were not run are less certain than those of other leaves.
    pub fn is_marked(&self) -> bool {
        self.beside || self.impacts_differ
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
        let whole = level < self.boxes.levels();
        // Those of the finest level have no cell that was not run.
        let beside = whole && self.boxes.is_beside_smaller(square);
        let impacts_differ = whole && self.impacts_differ(square);
        let leaf = |column, row, width, height| {
            let place = self.place_of(row * self.boxes.shape().0 + column);
            Leaf { level, column, row, width, height, beside, impacts_differ, place }
        };
        if whole {
            leaves.push(leaf(columns.start, rows.start, columns.len(), rows.len()));
            return;
        }
        for row in rows {
            leaves.extend(columns.clone().map(|column| leaf(column, row, 1, 1)));
        }
    }

    /// True where the corners of a leaf overturn after different numbers of impacts that are not told apart.
    fn impacts_differ(&self, square: Square) -> bool {
        let width = self.boxes.shape().0;
        let (columns, rows) = self.boxes.cells(square);
        let corner = |row: &usize, column: &usize| {
            let mut outcome = [Outcome::PENDING];
            let place = self.place_of(row * width + column);
            self.block().read(place, &COUNTS, &mut outcome);
            outcome[0]
        };
        let first = corner(rows.start(), columns.start());
        if !first.class.overturned() || first.counted_impacts().is_some() {
            return false;
        }
        let others = [
            corner(rows.start(), columns.end()),
            corner(rows.end(), columns.start()),
            corner(rows.end(), columns.end()),
        ];
        others.iter().any(|corner| corner.impacts != first.impacts)
    }

    /// Counts the leaves and the cells of those that are marked.
    pub(super) fn count_leaves(&mut self) {
        let (leaves, columns) = (self.leaves(), self.report.shape.0);
        let ran = |leaf: &Leaf| -> usize {
            let row = |row: usize| {
                let first = row * columns + leaf.column;
                self.place_of(first + leaf.width) - self.place_of(first)
            };
            (leaf.row..leaf.row + leaf.height).map(row).sum()
        };
        let count = |is_of: fn(&Leaf) -> bool| -> usize {
            let not_run = |number: usize| {
                let leaf = &leaves[number];
                if is_of(leaf) { leaf.width * leaf.height - ran(leaf) } else { 0 }
            };
            parallel::each(leaves.len(), parallel::LOOKUPS, not_run).into_iter().sum()
        };
        let beside = count(|leaf| leaf.beside);
        let impacts_differ = count(|leaf| leaf.impacts_differ);
        let marked = count(Leaf::is_marked);
        self.report.leaves = leaves.len();
        (self.report.beside, self.report.impacts_differ) = (beside, impacts_differ);
        self.report.marked = marked;
    }

    /// Hands the leaves over as a list of cells, with the level, the width and the height of each.
    pub fn listed<T>(&self, see: impl FnOnce(FileCells, &dyn Outcomes) -> T) -> T {
        let leaves = self.leaves();
        let columns = self.report.shape.0;
        let cells: Vec<usize> =
            leaves.iter().map(|leaf| leaf.row * columns + leaf.column).collect();
        let count = |name, meaning, value: fn(&Leaf) -> usize| {
            // A side of the finest grid has fewer than 2^32 cells.
            let values = leaves.iter().map(|leaf| value(leaf) as u32).collect();
            CountColumn { name, meaning, values }
        };
        let [level, width, height, beside, impacts_differ] = listed::COUNTS;
        let is_an_axis = self.grid.axes().iter().any(|axis| axis.key() == height);
        let height = if is_an_axis { listed::LEAF_HEIGHT } else { height };
        let counts = [
            count(level, "level of the leaf: 0 is between cells of the map", |leaf| {
                leaf.level as usize
            }),
            count(
                width,
                "cells of the finest grid along the first axis, from this one on",
                |leaf| leaf.width,
            ),
            count(
                height,
                "cells of the finest grid along the second axis, from this one on",
                |leaf| leaf.height,
            ),
            count(
                beside,
                "1 where a leaf beside it is smaller: a boundary is near, and its cells that were not run are less sure",
                |leaf| usize::from(leaf.beside),
            ),
            count(
                impacts_differ,
                "1 where its corners overturn after different numbers of impacts, 10 or more: its cells that were not run are less sure",
                |leaf| usize::from(leaf.impacts_differ),
            ),
        ];
        let outcomes = LeafOutcomes { map: self, leaves: &leaves };
        let list = CellList { cells: &cells, counts: &counts, index: "leaf" };
        see(FileCells { grid: &self.grid, list: Some(list) }, &outcomes)
    }
}
