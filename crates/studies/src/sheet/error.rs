//! What is wrong with a table, and where.

use topple::scene::shown::shown;

/// The fault of a table of text with its place, where it has one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{problem}", place(*.line, .column.as_deref()))]
pub struct TableError {
    /// The line, from 1.
    pub line: Option<usize>,
    /// The column, by its heading.
    pub column: Option<String>,
    /// The fault and the remedy; keys of a scene stand in backquotes.
    pub problem: String,
}

impl TableError {
    /// A fault of the whole table.
    pub fn whole(problem: impl Into<String>) -> TableError {
        TableError { line: None, column: None, problem: problem.into() }
    }

    /// A fault of a line.
    pub fn at(line: usize, problem: impl Into<String>) -> TableError {
        TableError { line: Some(line), column: None, problem: problem.into() }
    }

    /// A fault of a cell.
    pub fn of_cell(line: usize, column: &str, problem: impl Into<String>) -> TableError {
        TableError { column: Some(column.into()), ..TableError::at(line, problem) }
    }
}

fn place(line: Option<usize>, column: Option<&str>) -> String {
    match (line, column) {
        (Some(line), Some(column)) => format!("line {line}, column {}: ", shown(column)),
        (Some(line), None) => format!("line {line}: "),
        _ => String::new(),
    }
}
