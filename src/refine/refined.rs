//! A refined map: cells that were run, and leaves that hold the others.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::boxes::{Boxes, Square};
use super::report::RefineReport;
use super::smooth::{between, numbers, places};
use crate::model::precision::Precision;
use crate::results::about::Source;
use crate::results::block::Block;
use crate::results::column_set::ColumnSet;
use crate::results::columns::Column;
use crate::results::outcomes::Outcomes;
use crate::scene::{Grid, Scene};
use crate::stepping::outcome::Outcome;

/// The cells that were run, with their outcomes.
pub struct RanCells {
    precision: Precision,
    /// The requested columns.
    columns: ColumnSet,
    /// The numbers of the cells in the finest grid.
    cells: Vec<usize>,
    blocks: Vec<Block>,
}

impl RanCells {
    /// No cells yet; `columns` are the requested columns, in a number type.
    pub fn new(precision: Precision, columns: ColumnSet) -> RanCells {
        RanCells { precision, columns, cells: Vec::new(), blocks: Vec::new() }
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// True where there is no cell.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Adds cells.
    pub fn add(&mut self, cells: &[usize], outcomes: &[Outcome]) {
        let mut block = Block::pending(cells.len(), self.precision);
        block.put(0, outcomes);
        self.cells.extend(cells);
        self.blocks.push(block);
    }

    /// The same cells in the order of the grid, in one block.
    pub fn sorted(mut self) -> RanCells {
        let starts: Vec<usize> = self
            .blocks
            .iter()
            .scan(0, |start, block| Some(std::mem::replace(start, *start + block.len())))
            .collect();
        let mut order: Vec<usize> = (0..self.cells.len()).collect();
        order.sort_unstable_by_key(|number| self.cells[*number]);
        let mut sorted = Block::pending(order.len(), self.precision);
        for (place, number) in order.iter().enumerate() {
            // The last block that begins at or before it: empty ones lie before.
            let block = starts.partition_point(|start| start <= number) - 1;
            let mut outcome = [Outcome::PENDING];
            self.blocks[block].read(number - starts[block], &Column::ALL, &mut outcome);
            sorted.put(place, &outcome);
        }
        self.cells = order.into_iter().map(|number| self.cells[number]).collect();
        self.blocks = vec![sorted];
        self
    }
}

/// A refined map. Its [`Outcomes`] are those of the finest grid: of a cell that was not run the outcome and all numbers
/// of the leaf's first cell; where numbers are to be [smooth](super::settings::RefineSettings::smooth), the rocking
/// index, the least contact force and the strokes are those between the leaf's corners.
pub struct RefinedMap {
    /// The scene, its axes those of the finest grid.
    pub scene: Scene,
    /// The finest grid.
    pub grid: Grid,
    /// The report of the refinement.
    pub report: RefineReport,
    pub(super) boxes: Boxes,
    ran: RanCells,
}

impl RefinedMap {
    pub(super) fn new(
        scene: Scene,
        grid: Grid,
        boxes: Boxes,
        ran: RanCells,
        report: RefineReport,
    ) -> RefinedMap {
        RefinedMap { scene, grid, report, boxes, ran }
    }

    /// The cells that were run, in ascending order.
    pub fn cells(&self) -> &[usize] {
        &self.ran.cells
    }

    /// The outcome of a cell that was run, by its place among them.
    pub fn outcome_of(&self, place: usize) -> Outcome {
        let mut outcome = [Outcome::PENDING];
        self.ran.blocks[0].read(place, &Column::ALL, &mut outcome);
        outcome[0]
    }

    /// The columns of the cells that were run.
    pub(super) fn block(&self) -> &Block {
        &self.ran.blocks[0]
    }

    /// The place of a cell among those that were run.
    pub(super) fn place_of(&self, cell: usize) -> usize {
        self.ran.cells.partition_point(|other| *other < cell)
    }

    /// The place of the first cell of a leaf among those that were run.
    fn first_of(&self, leaf: Square) -> usize {
        let (columns, rows) = self.boxes.cells(leaf);
        self.place_of(rows.start() * self.boxes.shape().0 + columns.start())
    }

    /// Puts the numbers between those of a leaf's corners in the outcomes of its cells from one on, along a row.
    fn interpolate(&self, leaf: Square, (column, row): (usize, usize), some: &mut [Outcome]) {
        let (columns, rows) = self.boxes.cells(leaf);
        let corner = |row: &usize, column: &usize| {
            numbers(&self.outcome_of(self.place_of(row * self.boxes.shape().0 + column)))
        };
        let corners = [
            corner(rows.start(), columns.start()),
            corner(rows.start(), columns.end()),
            corner(rows.end(), columns.start()),
            corner(rows.end(), columns.end()),
        ];
        let side = self.boxes.side(leaf.level) as f64;
        let y = (row - rows.start()) as f64 / side;
        for (column, outcome) in (column..).zip(some) {
            let x = (column - columns.start()) as f64 / side;
            for (place, number) in places(outcome).into_iter().zip(between(&corners, [x, y])) {
                *place = number;
            }
        }
    }

    /// What the files of the map say about its origin.
    pub fn source(&self) -> Source<'_> {
        let RanCells { precision, columns, .. } = self.ran;
        Source { scene: &self.scene, precision, columns }
    }
}

impl Outcomes for RefinedMap {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let (width, height) = self.boxes.shape();
        let (mut outcomes, block) = (vec![Outcome::PENDING; cells.len()], self.block());
        let mut next = self.ran.cells.partition_point(|cell| *cell < cells.start);
        let mut cell = cells.start;
        while cell < cells.end {
            if self.ran.cells.get(next) == Some(&cell) {
                let place = cell - cells.start;
                block.read(next, columns, &mut outcomes[place..place + 1]);
                (next, cell) = (next + 1, cell + 1);
                continue;
            }
            // A run of cells of one leaf.
            let (column, row) = (cell % width, cell / width);
            let leaf = self.boxes.leaf(column.min(width - 2), row.min(height - 2));
            let mut of_leaf = [Outcome::PENDING];
            block.read(self.first_of(leaf), columns, &mut of_leaf);
            let end = cell - column + self.boxes.cells(leaf).0.end() + 1;
            let ran = self.ran.cells.get(next).copied().unwrap_or(usize::MAX);
            let end = end.min(ran).min(cells.end);
            let some = &mut outcomes[cell - cells.start..end - cells.start];
            some.fill(of_leaf[0]);
            if self.report.smooth.is_some() {
                self.interpolate(leaf, (column, row), some);
            }
            cell = end;
        }
        Ok(Cow::Owned(outcomes))
    }
}
