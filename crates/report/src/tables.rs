//! Numbers and tables as readers want them.

use topple::scene::record::rounded;

use super::document::Piece;
use super::folder::{Row, Rows};

/// Most rows of a table that are printed; the whole table lies in the run's directory.
pub const ROWS: usize = 24;

/// A number for readers: three digits, a small one with a power of ten.
pub fn number(value: f64) -> String {
    let short = rounded(value, 3);
    if short != 0.0 && short.abs() < 1.0e-4 { format!("{short:e}") } else { short.to_string() }
}

/// The number in a cell of a table; none where the cell holds none.
pub fn value(row: &Row, column: &str) -> Option<f64> {
    row.get(column)?.parse().ok()
}

/// A cell of a table as a reader wants it: numbers with three digits.
pub fn shown(row: &Row, column: &str) -> String {
    let Some(text) = row.get(column).filter(|text| !text.is_empty()) else { return "–".into() };
    text.parse().map_or_else(|_| text.clone(), number)
}

/// That a table has more rows than are shown.
pub fn more(rows: &Rows) -> Option<Piece> {
    let text =
        || format!("The first {ROWS} of {} rows; all are in the run's directory.", rows.len());
    (rows.len() > ROWS).then(|| Piece::Text(text()))
}

/// Columns of a table under names of their own, no more than [`ROWS`] rows of it.
pub fn table(rows: &Rows, columns: &[(&str, &str)]) -> Vec<Piece> {
    let there = |column: &str| rows.first().is_some_and(|row| row.contains_key(column));
    let columns: Vec<&(&str, &str)> = columns.iter().filter(|(column, _)| there(column)).collect();
    let names = columns.iter().map(|(_, name)| name.to_string()).collect();
    let some = rows.iter().take(ROWS);
    let cells = some.map(|row| columns.iter().map(|(column, _)| shown(row, column)).collect());
    let mut pieces = vec![Piece::Table(names, cells.collect())];
    pieces.extend(more(rows));
    pieces
}
