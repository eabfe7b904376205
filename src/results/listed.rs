//! Some of a grid's cells, in any order, with counts of their own beside the columns: as a table, and as arrays of one
//! index.

use super::outcomes::Outcomes;
use crate::scene::Grid;

/// A count that each of the cells has, such as the width of what it stands for.
#[derive(Debug, Clone)]
pub struct CountColumn {
    /// Its name in files.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// A value a cell.
    pub values: Vec<u32>,
}

/// Cells of a grid, by their numbers, with their outcomes in the same order.
pub struct ListedCells<'a> {
    /// The grid that numbers them.
    pub grid: &'a Grid,
    /// Their numbers.
    pub cells: &'a [usize],
    /// Counts of their own.
    pub counts: &'a [CountColumn],
    /// Their outcomes: number k is that of the k-th of them.
    pub outcomes: &'a dyn Outcomes,
    /// What one of them is: the index of their arrays.
    pub index: &'static str,
}
