//! Plain numbers: one column of values, or time and value, with blanks, tabs, commas or semicolons between. Beside
//! semicolons a comma is a decimal one. A row with the count of the samples, or with the count and the step, may stand
//! before them; after it several values may stand in a row. Other rows of three numbers and more are in `several`.

mod alarm;
pub mod directions;
mod meaning;
mod named;
mod polarity;
mod rows;
pub mod several;
mod signs;
mod table;
mod timed;
mod told;
pub mod unit_words;
pub mod values;
pub mod words;

use std::borrow::Cow;

use crate::hints::RecordHints;
use crate::numbers::{free, number};
use crate::shown::shown;
use crate::{Raw, RecordError, Stated, dated};
use rows::Rows;
use told::Told;

/// Most lines of a heading.
const HEADING: usize = 20;

/// How comments begin.
const COMMENT: [char; 3] = ['#', '%', '!'];

/// The record in a file of plain numbers.
///
/// # Errors
/// The first line that is not read, or says what is not known, and the remedy.
pub fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let Some(dated) = dated::plain(text, 10 * HEADING)? else {
        return of_numbers(text, hints, Told::new(hints));
    };
    let mut raw = of_numbers(&dated.text, hints, Told::of_dates(hints))?;
    raw.stated.start = Some(dated.start);
    raw.notes.push(format!("its rows begin with dates: times from {} on", shown(&dated.first)));
    Ok(raw)
}

/// The record in rows of numbers.
fn of_numbers(text: &str, hints: &RecordHints, mut told: Told) -> Result<Raw, RecordError> {
    let mut title = String::new();
    let mut rows = Rows::default();
    let mut commas = false;
    let mut empty = None;
    for (index, line) in text.lines().enumerate() {
        let at = index + 1;
        let line = line.trim();
        if line.starts_with(COMMENT) && rows.are_to_come() {
            told.by_comment(at, line.trim_start_matches(COMMENT).trim())?;
        }
        if line.is_empty() || line.starts_with(COMMENT) {
            continue;
        }
        let row = Row::new(at, line)?;
        commas |= row.has_commas();
        let fields = row.fields();
        let Some(numbers) = numbers(&fields) else {
            // Words before the first sample are a heading, of one line or several.
            let begins = fields.first().is_some_and(|first| number(first).is_some());
            let first = rows.are_none() && title.is_empty() && !told.has_units();
            if rows.are_to_come() && (first || !begins) && at <= HEADING {
                // Names of columns are no title.
                if !told.by_heading(at, line, title.is_empty())? && title.is_empty() {
                    title = line.chars().take(80).collect();
                }
                continue;
            }
            let hint = match (line.matches(':').count(), line.contains(',')) {
                _ if rows.are_several() => "",
                (1.., _) => "; a time is read in s, as 2003-01-02T03:04:05.01, or as 03:04:05.01",
                (_, true) => "; if its commas are decimal ones, write points",
                _ => "; is the file of a known format?",
            };
            return Err(RecordError::line(at, format!("this is not a number{hint}")));
        };
        if numbers.is_empty() {
            // Nothing but separators, as a spreadsheet leaves below its last row.
            if !rows.are_none() {
                empty.get_or_insert(at);
            }
            continue;
        }
        if let Some(empty) = empty {
            let problem = "an empty row amid the samples; fill it in, or cut the record there";
            return Err(RecordError::line(empty, problem));
        }
        // Asked of the first row alone: what looks at the lines above reads the text again.
        let is_several = |columns| columns > 2 || columns == 2 && named::is_pair(text, at);
        rows.add((at, line), &fields, numbers, is_several)?;
    }
    let decimal_commas = commas.then(|| "decimal commas".to_string());
    match rows.table()? {
        Ok(table) => {
            let mut raw = several::read(text, table, hints, told, title)?;
            raw.notes.extend(decimal_commas);
            Ok(raw)
        }
        Err(rows) => {
            let mut raw = rows.record(&told, hints.dt)?;
            raw.notes.extend(decimal_commas);
            told.complete(titled(raw, title))
        }
    }
}

/// A record with its title, and what that states: without a place and a component it is a heading of columns, and with the
/// ways of all components of a recorder it is no place.
fn titled(mut raw: Raw, title: String) -> Raw {
    let stated = Stated::of_title(&title);
    let of_all = polarity::phrase(&title).is_some_and(|ways| ways.of_all);
    if !stated.event.is_empty() && !of_all {
        raw.stated = Stated { start: raw.stated.start, ..stated };
    }
    raw.title = title;
    raw
}

/// Refuses a row of semicolons with decimal commas in one number and a point in another: the one may separate thousands.
fn refuse_two_signs(at: usize, line: &str) -> Result<(), RecordError> {
    let fields = || {
        line.split(';').map(str::trim).filter(|field| {
            field.contains(|c: char| c.is_ascii_digit())
                && field.chars().all(|c| c.is_ascii_digit() || "+-.,".contains(c))
        })
    };
    let with = |sign| fields().find(|field| field.contains(sign));
    // Dates in the first field have become seconds with a point.
    match (with(','), fields().skip(1).find(|field| field.contains('.'))) {
        (Some(comma), Some(point)) => {
            let (comma, point) = (shown(comma), shown(point));
            let problem = format!(
                "'{comma}' has a comma and '{point}' a point: one of them may separate thousands; write one decimal sign, and no other"
            );
            Err(RecordError::line(at, problem))
        }
        _ => Ok(()),
    }
}

/// A line of numbers, its decimal commas as points.
struct Row<'a>(Cow<'a, str>);

impl Row<'_> {
    /// Line `at`.
    ///
    /// # Errors
    /// Decimal commas beside points.
    fn new(at: usize, line: &str) -> Result<Row<'_>, RecordError> {
        if !line.contains(';') || !line.contains(',') {
            return Ok(Row(line.into()));
        }
        refuse_two_signs(at, line)?;
        let is_row = line.contains(|c: char| c.is_ascii_digit());
        Ok(Row(if is_row { line.replace(',', ".").into() } else { line.into() }))
    }

    fn has_commas(&self) -> bool {
        matches!(self.0, Cow::Owned(_))
    }

    fn fields(&self) -> Vec<&str> {
        free(&self.0)
    }
}

/// The numbers of fields, if all are some.
fn numbers(fields: &[&str]) -> Option<Vec<f64>> {
    fields.iter().map(|field| number(field)).collect()
}
