//! Columns of a suite's tables: the axes of its sweep, and the results of each cell or motion.

use topple::results::csv::Number;
use topple::scene::Grid;

/// The names of the axes.
pub fn keys(grid: &Grid) -> impl Iterator<Item = &'static str> {
    grid.told().into_iter().map(|place| grid.axes()[place].key())
}

/// Their values in a cell.
pub fn values(grid: &Grid, cell: usize) -> Vec<Number> {
    let values: Vec<f64> = grid.coordinates(cell).collect();
    grid.told().into_iter().map(|place| Number(values[place])).collect()
}

/// A column of a table.
#[derive(Debug, Clone, Copy)]
pub struct TableColumn {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: ColumnUnit,
    /// What it means.
    pub meaning: &'static str,
}

/// The unit of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnUnit {
    /// Names have none.
    Name,
    /// A number of this unit, 1 where it is a share or a count.
    Of(&'static str),
    /// That of the intensity measure of the study.
    OfMeasure,
}

/// A column of names.
pub const fn name(name: &'static str, meaning: &'static str) -> TableColumn {
    TableColumn { name, unit: ColumnUnit::Name, meaning }
}

/// A column of numbers of a unit.
pub const fn number(name: &'static str, unit: &'static str, meaning: &'static str) -> TableColumn {
    TableColumn { name, unit: ColumnUnit::Of(unit), meaning }
}

/// A column of values of the intensity measure.
pub const fn measure(name: &'static str, meaning: &'static str) -> TableColumn {
    TableColumn { name, unit: ColumnUnit::OfMeasure, meaning }
}

/// The names of a table's columns.
pub fn names(columns: &[TableColumn]) -> impl Iterator<Item = &'static str> {
    columns.iter().map(|column| column.name)
}
