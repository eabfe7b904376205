//! The axes of a suite's sweep as columns of its tables.

use crate::results::csv::Number;
use crate::scene::Grid;

/// The names of the axes.
pub fn keys(grid: &Grid) -> impl Iterator<Item = &'static str> {
    grid.told().into_iter().map(|place| grid.axes()[place].key())
}

/// Their values in a cell.
pub fn values(grid: &Grid, cell: usize) -> Vec<Number> {
    let values: Vec<f64> = grid.coordinates(cell).collect();
    grid.told().into_iter().map(|place| Number(values[place])).collect()
}
