//! Columns of a suite's tables: the axes of its sweep, and the results of each cell or motion.

use topple::results::column_set::ColumnSet;
use topple::results::columns::{Column, ColumnKind};
use topple::results::csv::Number;
use topple::scene::{Grid, SceneError};

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

/// A number of a table; empty where it is not known.
pub(crate) fn known(value: f64) -> Option<Number> {
    (!value.is_nan()).then_some(Number(value))
}

/// Percentiles of a column of a map, as parts of a table's names.
const SHARES: [&str; 3] = ["50", "84", "100"];

/// The names of the columns of percentiles of a column, with its unit and what each means.
pub fn further(column: Column) -> [(String, &'static str, String); 3] {
    let entry = column.entry();
    let unit = if entry.unit.is_empty() { "1" } else { entry.unit };
    SHARES.map(|share| {
        let meaning = format!(
            "what {share} % of the motions under which it stands do not exceed of: {}",
            entry.meaning
        );
        (format!("{}_{share}", entry.name), unit, meaning)
    })
}

/// The names of those of several columns.
pub(crate) fn further_names(columns: &[Column]) -> impl Iterator<Item = String> {
    columns.iter().flat_map(|column| further(*column)).map(|(name, ..)| name)
}

/// The columns that a table has beside the strokes, which every one has: of all columns those that have percentiles.
pub fn asked(columns: ColumnSet) -> Vec<Column> {
    let named = columns.columns().filter(|one| !matches!(one, Column::MaxU | Column::StrokeV));
    named.filter(|one| !columns.is_all() || is_number(*one)).collect()
}

/// True of a column of numbers.
fn is_number(column: Column) -> bool {
    matches!(column.entry().kind, ColumnKind::Number | ColumnKind::Count)
}

/// Refuses further columns that have no percentiles.
///
/// # Errors
/// The first of them.
pub fn check_further(columns: &[Column]) -> Result<(), SceneError> {
    match columns.iter().find(|one| !is_number(**one)) {
        Some(column) => {
            let problem = format!("{} has names, not numbers; leave it out", column.entry().name);
            Err(SceneError::new("columns", problem))
        }
        None => Ok(()),
    }
}
