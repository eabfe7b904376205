//! Tables of text: lists of records, PEER's search results, lists of devices, hazard curves.
//!
//! ```text
//! rows (separators, quotes, comments, lines) -> sheet (heading, columns) -> cells -> numbers (which sign is the decimal one)
//! ```

mod error;
pub mod numbers;
pub mod rows;

use std::borrow::Cow;
use std::collections::BTreeSet;

pub use error::TableError;
pub use numbers::{Decimals, is_number};
pub use rows::{BLANKS, Row, Rows, comments};
use topple::scene::shown::shown;

/// A table with its heading.
pub struct Sheet<'a> {
    /// The line of the heading.
    pub line: usize,
    /// The names of the columns; empty ones of columns in which nothing may stand.
    pub names: Vec<Cow<'a, str>>,
    decimals: Decimals,
    rows: Rows<'a>,
}

/// What stands in a column of a row; empty where nothing does.
#[derive(Clone, Copy)]
pub struct Cell<'a> {
    line: usize,
    column: &'a str,
    /// What stands there.
    pub text: &'a str,
    decimals: Decimals,
}

impl<'a> Sheet<'a> {
    /// A table whose first row is its heading; none of a text without rows. `is_words` is true of the names of columns in which words
    /// stand, also where they look like numbers.
    ///
    /// # Errors
    /// A column that stands twice, and what makes no row.
    pub fn of(
        mut rows: Rows<'a>,
        is_words: impl Fn(&str) -> bool,
    ) -> Result<Option<Sheet<'a>>, TableError> {
        let Some(Row { line, cells: names }) = rows.next().transpose()? else { return Ok(None) };
        Sheet::named(line, names, rows, is_words).map(Some)
    }

    /// The rows that are left, with the names of their columns.
    ///
    /// # Errors
    /// A column that stands twice.
    pub fn named(
        line: usize,
        names: Vec<Cow<'a, str>>,
        rows: Rows<'a>,
        is_words: impl Fn(&str) -> bool,
    ) -> Result<Sheet<'a>, TableError> {
        let mut known = BTreeSet::new();
        for name in names.iter().filter(|name| !name.is_empty()) {
            if !known.insert(name.to_lowercase().replace('-', "_")) {
                return Err(TableError::of_cell(line, name, "it stands twice; leave one out"));
            }
        }
        let decimals = Decimals::of(&rows, |at| names.get(at).is_some_and(|name| is_words(name)));
        Ok(Sheet { line, names, decimals, rows })
    }

    /// Its rows below the heading, each with a cell in every column that has a name, and with nothing in others.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row<'a>, TableError>> {
        let columns = self.names.iter().rposition(|name| !name.is_empty()).map_or(0, |at| at + 1);
        self.rows.clone().map(move |row| {
            let row = row?;
            let is_named = |at: usize| self.names.get(at).is_some_and(|name| !name.is_empty());
            let cells = row.cells.iter().enumerate();
            let unnamed = cells.filter(|(_, cell)| !cell.is_empty()).find(|(at, _)| !is_named(*at));
            // Spreadsheets leave separators at the ends of rows; what stands there has no name.
            if let Some((_, cell)) = unnamed {
                let problem = format!(
                    "'{}' stands in a column without a name; name the column, or leave its cells empty",
                    shown(cell)
                );
                return Err(TableError::at(row.line, problem));
            }
            if row.cells.len() < columns {
                let own = row.cells.len();
                let problem =
                    format!("{own} fields where the heading has {columns}; give each column a field");
                return Err(TableError::at(row.line, problem));
            }
            Ok(row)
        })
    }

    /// Refuses a comment that may be a row whose name begins with `#`: a number follows it, and there are as many cells as columns.
    ///
    /// # Errors
    /// Its line, and what to do.
    pub fn without_numbered_comments(self, text: &str) -> Result<Sheet<'a>, TableError> {
        let columns = self.names.iter().filter(|name| !name.is_empty()).count();
        let separator = self.rows.separator();
        let is_row = |comment: &str| {
            comment.starts_with(|c: char| c.is_ascii_digit())
                && columns > 1
                && comment.split(separator).count() >= columns
        };
        match comments(text).find(|(line, comment)| *line > self.line && is_row(comment)) {
            None => Ok(self),
            Some((line, _)) => {
                let problem = "`#` begins a comment, and this one has the cells of a row; put quotes around the name, or a blank behind `#`";
                Err(TableError::at(line, problem))
            }
        }
    }

    /// Its rows as they are.
    pub fn loose_rows(&self) -> Rows<'a> {
        self.rows.clone()
    }

    /// The cell of a row in a column.
    pub fn cell<'b>(&'b self, row: &'b Row, at: usize) -> Cell<'b> {
        let text = |cells: &'b [Cow<str>]| cells.get(at).map_or("", |cell| &**cell);
        Cell {
            line: row.line,
            column: text(&self.names),
            text: text(&row.cells),
            decimals: self.decimals,
        }
    }
}

/// What may be wrong with the comments of a table that has a heading: the first that has as many cells, and no blank behind its `#`, may be
/// a row whose name begins with `#`.
pub fn row_in_comment(text: &str) -> Option<String> {
    let mut rows = Rows::of(text, 1, false).ok()?;
    let heading = rows.next()?.ok()?;
    let columns = heading.cells.iter().filter(|name| !name.is_empty()).count();
    let is_row = |comment: &str| {
        let cells = comment.split(rows.separator()).count();
        columns > 1
            && (columns..=heading.cells.len()).contains(&cells)
            && !comment.starts_with(char::is_whitespace)
    };
    let (line, _) =
        comments(text).find(|(line, comment)| *line > heading.line && is_row(comment))?;
    Some(format!(
        "line {line} has the cells of a row and begins with `#`, as comments do: it is left out; put quotes around its name if it is a \
         row, or a blank behind `#`"
    ))
}

impl Cell<'_> {
    /// Its number; none where nothing is written.
    ///
    /// # Errors
    /// What is no number, and what may be one of two.
    pub fn number(self) -> Result<Option<f64>, TableError> {
        if self.text.is_empty() {
            return Ok(None);
        }
        self.decimals.number(self.text).map(Some).map_err(|problem| self.refused(problem))
    }

    /// A fault of it.
    pub fn refused(self, problem: impl Into<String>) -> TableError {
        TableError::of_cell(self.line, self.column, problem)
    }
}
