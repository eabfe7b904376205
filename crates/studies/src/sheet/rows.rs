//! The rows of a table of text: what separates cells, quotes, comments, and the line in which each row begins.

use std::borrow::Cow;

use super::error::TableError;

/// The separators that are looked for.
const SEPARATORS: [char; 3] = [',', ';', '\t'];
/// Stands for any number of blanks between cells.
pub const BLANKS: char = ' ';
/// Most cells of a row: a line of separators alone would fill the memory.
const MOST_CELLS: usize = 10_000;
/// The ends of lines; a return and a line feed end one line.
const ENDS: [char; 2] = ['\n', '\r'];

/// A row with the line in which it begins, from 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<'a> {
    /// Its line.
    pub line: usize,
    /// Its cells, without blanks around them and without their quotes.
    pub cells: Vec<Cow<'a, str>>,
}

/// The rows of a text in order. Lines that begin with `#`, and rows of empty cells, are left out.
#[derive(Debug, Clone)]
pub struct Rows<'a> {
    rest: &'a str,
    line: usize,
    separator: char,
    /// True where each line as a whole is within quotes.
    wrapped: bool,
}

impl<'a> Rows<'a> {
    /// The rows of a text whose first line has the number `line`. The separator is that of a spreadsheet's first line `sep=;`, or what
    /// stands most often in the first row: commas, semicolons or tabs. Where none of them stands there, blanks separate if `blanks` is true.
    ///
    /// # Errors
    /// A line `sep=` with another separator.
    pub fn of(text: &'a str, line: usize, blanks: bool) -> Result<Rows<'a>, TableError> {
        let rest = text.trim_start_matches('\u{feff}');
        let mut rows = Rows { rest, line, separator: ',', wrapped: false };
        let stated = first_line(rest).get(..4).filter(|word| word.eq_ignore_ascii_case("sep="));
        let stated = match stated {
            None => None,
            Some(_) => {
                let sign = first_line(rest).chars().nth(4);
                rows.end_line();
                let known = |sign: &char| SEPARATORS.contains(sign) || *sign == '|';
                let problem =
                    "`sep=` names no separator that is read; give a comma, a semicolon or a tab";
                Some(sign.filter(known).ok_or_else(|| TableError::at(line, problem))?)
            }
        };
        rows.skip_to_row();
        let first = first_line(rows.rest);
        let inner = within_quotes(first.trim());
        rows.wrapped = inner.is_some();
        let found = || separator(inner.unwrap_or(first), blanks);
        rows.separator = stated.unwrap_or_else(found);
        Ok(rows)
    }

    /// What separates the cells, [`BLANKS`] where blanks do.
    pub fn separator(&self) -> char {
        self.separator
    }

    /// Goes on behind the end of the line.
    fn end_line(&mut self) {
        let at = self.rest.find(ENDS).unwrap_or(self.rest.len());
        let ends = &self.rest[at..];
        let length = if ends.starts_with("\r\n") { 2 } else { ends.len().min(1) };
        (self.rest, self.line) = (&ends[length..], self.line + 1);
    }

    /// Goes on to a line that is neither empty nor a comment.
    fn skip_to_row(&mut self) {
        while !self.rest.is_empty() {
            let line = first_line(self.rest).trim_start();
            if !line.is_empty() && !line.starts_with('#') {
                break;
            }
            self.end_line();
        }
    }

    fn row(&mut self) -> Result<Row<'a>, TableError> {
        let mut row = Row { line: self.line, cells: Vec::new() };
        if self.separator == BLANKS {
            let words = first_line(self.rest).split_whitespace().take(MOST_CELLS);
            row.cells.extend(words.map(Cow::Borrowed));
            self.end_line();
            return Ok(row);
        }
        loop {
            if row.cells.len() == MOST_CELLS {
                let problem = format!("more than {MOST_CELLS} cells; give a row a line");
                return Err(TableError::at(row.line, problem));
            }
            row.cells.push(self.cell()?);
            match self.rest.strip_prefix(self.separator) {
                Some(rest) => self.rest = rest,
                None => break,
            }
        }
        self.end_line();
        let (true, [line]) = (self.wrapped, &row.cells[..]) else { return Ok(row) };
        let mut inner =
            Rows { rest: line, line: row.line, separator: self.separator, wrapped: false };
        let cells = inner.row()?.cells;
        let cells = cells.into_iter().map(|cell| Cow::Owned(cell.into_owned())).collect();
        Ok(Row { line: row.line, cells })
    }

    /// The next cell; a separator or the end of the line stands behind it.
    fn cell(&mut self) -> Result<Cow<'a, str>, TableError> {
        let separator = self.separator;
        let is_end = move |c: char| c == separator || ENDS.contains(&c);
        let is_blank = |c: char| c.is_whitespace() && !is_end(c);
        let start = self.rest.trim_start_matches(is_blank);
        let Some(inner) = start.strip_prefix('"') else {
            let (cell, rest) = start.split_at(start.find(is_end).unwrap_or(start.len()));
            self.rest = rest;
            return Ok(Cow::Borrowed(cell.trim()));
        };
        let end = end_of_quoted(inner).ok_or_else(|| {
            let problem = "a cell begins with a quote (\") that no other one ends; add it";
            TableError::at(self.line, problem)
        })?;
        let (quoted, rest) = (&inner[..end], &inner[end + 1..]);
        let breaks = quoted.replace("\r\n", "\n");
        if breaks.contains(ENDS) && separator != BLANKS && quoted.contains(separator) {
            let problem = format!(
                "a cell within quotes has a line break and a `{separator}`: it may hold other rows; end the quote in its own line"
            );
            return Err(TableError::at(self.line, problem));
        }
        self.line += breaks.matches(ENDS).count();
        // What stands between the quote and the separator is of the cell, too.
        let (more, rest) = rest.split_at(rest.find(is_end).unwrap_or(rest.len()));
        self.rest = rest;
        let more = more.trim_end();
        let plain = more.is_empty() && !quoted.contains("\"\"");
        Ok(match plain {
            true => Cow::Borrowed(quoted.trim()),
            false => Cow::Owned(format!("{}{more}", quoted.replace("\"\"", "\"")).trim().into()),
        })
    }
}

impl<'a> Iterator for Rows<'a> {
    type Item = Result<Row<'a>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            self.skip_to_row();
            if self.rest.is_empty() {
                return None;
            }
            let row = self.row();
            if row.is_err() {
                // What follows a fault is in no known column.
                self.rest = "";
            }
            match row {
                Ok(row) if row.cells.iter().all(|cell| cell.is_empty()) => {}
                row => return Some(row),
            }
        }
    }
}

/// The lines of a text that begin with `#`, without it, each with its number.
pub fn comments(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let rest = text.trim_start_matches('\u{feff}');
    // They are walked through as rows are, so that both have the same lines.
    let mut lines = Rows { rest, line: 1, separator: ',', wrapped: false };
    let walked = std::iter::from_fn(move || {
        let (line, text) = (lines.line, first_line(lines.rest));
        (!lines.rest.is_empty()).then(|| lines.end_line()).map(|()| (line, text))
    });
    walked.filter_map(|(line, text)| Some((line, text.trim().strip_prefix('#')?)))
}

fn first_line(text: &str) -> &str {
    &text[..text.find(ENDS).unwrap_or(text.len())]
}

/// Where the quote that ends a cell stands; one within the cell is doubled.
fn end_of_quoted(inner: &str) -> Option<usize> {
    let mut from = 0;
    loop {
        let at = from + inner.get(from..)?.find('"')?;
        if !inner[at + 1..].starts_with('"') {
            return Some(at);
        }
        from = at + 2;
    }
}

/// The line within one pair of quotes that holds all its fields.
fn within_quotes(line: &str) -> Option<&str> {
    let inner = line.strip_prefix('"')?.strip_suffix('"')?;
    // A quote within is doubled where it is no end of a field.
    let single = inner.replace("\"\"", "").contains('"');
    (!single && inner.contains(SEPARATORS)).then_some(inner)
}

/// What separates the cells of a first row: what stands in it most often outside of quotes. In a row of numbers commas are decimal
/// ones where another separator stands.
fn separator(first: &str, blanks: bool) -> char {
    let bare: String = first.split('"').step_by(2).collect();
    let count = |separator: char| bare.matches(separator).count();
    let of_numbers = !bare.contains(|c: char| c.is_alphabetic() && !"eE".contains(c));
    if of_numbers && let Some(other) = [';', '\t'].into_iter().find(|other| count(*other) > 0) {
        return other;
    }
    // Of equally many the first is taken.
    let most = SEPARATORS.into_iter().rev().max_by_key(|separator| count(*separator));
    match most {
        Some(separator) if count(separator) > 0 => separator,
        _ if blanks && bare.split_whitespace().nth(1).is_some() => BLANKS,
        _ => ',',
    }
}
