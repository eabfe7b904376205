//! Tables of text: lists of records, PEER's search results, lists of devices, hazard curves.
//!
//! ```text
//! rows (separators, quotes, comments, lines) -> sheet (heading, columns) -> cells -> numbers (which sign is the decimal one)
//! ```

mod error;
mod numbers;
mod rows;

use std::borrow::Cow;
use std::collections::BTreeSet;

pub use error::TableError;
pub(crate) use numbers::{Decimals, is_number};
pub(crate) use rows::{BLANKS, Row, Rows, comments};
use topple::scene::shown::shown;

/// A table with its heading.
pub(crate) struct Sheet<'a> {
    /// The line of the heading.
    pub line: usize,
    /// The names of the columns; empty ones of columns in which nothing may stand.
    pub names: Vec<Cow<'a, str>>,
    decimals: Decimals,
    rows: Rows<'a>,
}

/// What stands in a column of a row; empty where nothing does.
#[derive(Clone, Copy)]
pub(crate) struct Cell<'a> {
    line: usize,
    column: &'a str,
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

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        let sheet = match Sheet::of(Rows::of(text, 1, false).unwrap(), |_| false) {
            Ok(sheet) => sheet.unwrap(),
            Err(error) => return error.to_string(),
        };
        let rows: Result<Vec<Row>, TableError> = sheet.rows().collect();
        rows.map_or_else(|error| error.to_string(), |rows| format!("{} rows", rows.len()))
    }

    #[test]
    fn columns_have_names_and_rows_have_all_of_them() {
        for (text, wanted) in [
            ("a,b,,\n1,2,,\n3,4\n5,6,,,\n", "3 rows"),
            ("a,,b\n1,,2\n", "1 rows"),
            ("a,b,,\n1,2,3,\n", "line 2: '3' stands in a column without a name"),
            ("a,b\n1,2,3\n", "line 2: '3' stands in a column without a name"),
            ("a,b\n\n1\n", "line 3: 1 fields where the heading has 2"),
            ("t_h,b,T-H\n", "line 1, column T-H: it stands twice"),
        ] {
            assert!(error(text).starts_with(wanted), "{text:?}: {}", error(text));
        }
    }

    /// A name that looks like a number is none: it tells no decimal sign.
    #[test]
    fn names_tell_no_decimal_sign() {
        for name in ["2.1", "A", "1,5"] {
            let text = format!("device;k1\n{name};900.000\n");
            let rows = Rows::of(&text, 1, false).unwrap();
            let sheet = Sheet::of(rows, |name| name == "device").unwrap().unwrap();
            let row = sheet.rows().next().unwrap().unwrap();
            let said = sheet.cell(&row, 1).number().unwrap_err().to_string();
            assert!(said.contains("may be 900000 or 900"), "{name}: {said}");
        }
    }

    /// A quote that another row ends would hide the rows between.
    #[test]
    fn no_cell_holds_rows() {
        let rows = Rows::of("a,b\n\"A,1\nB\",2\n", 1, false).unwrap();
        let error = rows.skip(1).find_map(Result::err).unwrap().to_string();
        assert!(
            error.starts_with("line 2: a cell within quotes has a line break and a `,`"),
            "{error}"
        );
    }

    #[test]
    fn a_comment_with_the_cells_of_a_row_is_doubted() {
        for (text, line) in [
            ("a,b\n#A,1\nB,2\n", Some(2)),
            ("a,b,,\nB,2\n# c\n#A,1,,\n", Some(4)),
            ("a;b\n#A,1\n#A;1\n", Some(3)),
            ("#a,b\na,b\n# A,1\n#A\n#A,1,2\nB,2\n", None),
            ("a\n#A\nB\n", None),
            ("", None),
        ] {
            let said = row_in_comment(text).unwrap_or_default();
            let wanted = line.map_or(String::new(), |line| format!("line {line} has the cells"));
            assert!(
                said.starts_with(&wanted) && said.is_empty() == line.is_none(),
                "{text:?} {said}"
            );
        }
    }

    #[test]
    fn a_cell_has_its_place() {
        let rows = Rows::of("a;b\n\n0,5;200.000\n", 1, false).unwrap();
        let sheet = Sheet::of(rows, |_| false).unwrap().unwrap();
        let row = sheet.rows().next().unwrap().unwrap();
        assert_eq!(sheet.cell(&row, 0).number(), Ok(Some(0.5)));
        let error = sheet.cell(&row, 1).number().unwrap_err().to_string();
        assert_eq!(
            error,
            "line 3, column b: '200.000' may be 200000 or 200; write the one that is meant"
        );
        assert_eq!(sheet.cell(&row, 7).number(), Ok(None));
    }
}
