//! Plain numbers: one column of values, or time and value, with blanks, tabs, commas or semicolons between. Beside
//! semicolons a comma is a decimal one. A row with the count of the samples, or with the count and the step, may stand
//! before them; after it several values may stand in a row.

mod directions;
mod rows;
mod told;
mod values;
mod words;

use super::hints::RecordHints;
use super::numbers::{free, number};
use super::{Raw, RecordError, Stated};
use rows::Rows;
use told::Told;

/// Most lines of a heading.
const HEADING: usize = 20;

/// How comments begin.
const COMMENT: [char; 3] = ['#', '%', '!'];

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let mut title = String::new();
    let mut rows = Rows::default();
    let mut told = Told::new(hints);
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
        let is_row = line.contains(';') && line.contains(|c: char| c.is_ascii_digit());
        let point = is_row.then(|| line.replace(',', "."));
        commas |= point.is_some() && line.contains(',');
        let fields = free(point.as_deref().unwrap_or(line));
        let numbers: Option<Vec<f64>> = fields.iter().map(|field| number(field)).collect();
        let Some(numbers) = numbers else {
            // Words before the first sample are a heading, of one line or several.
            let begins = fields.first().is_some_and(|first| number(first).is_some());
            let first = rows.are_none() && title.is_empty() && !told.has_units();
            if rows.are_to_come() && (first || !begins) && at <= HEADING {
                // Names of columns are no title.
                if !told.by_heading(at, line)? && title.is_empty() {
                    title = line.chars().take(80).collect();
                }
                continue;
            }
            let hint = match line.contains(',') {
                true => "; if its commas are decimal ones, write points",
                false => "; is the file of a known format?",
            };
            return Err(RecordError::line(at, format!("this is not a number{hint}")));
        };
        if numbers.is_empty() {
            // Nothing but separators, as a spreadsheet leaves below its last row.
            empty.get_or_insert(at);
            continue;
        }
        if let (Some(empty), false) = (empty, rows.are_none()) {
            let problem = "an empty row amid the samples; fill it in, or cut the record there";
            return Err(RecordError::line(empty, problem));
        }
        rows.add(at, line, &fields, numbers)?;
    }
    let mut raw = rows.record(&told, hints.dt)?;
    if commas {
        raw.notes.push("decimal commas".to_string());
    }
    // Without a place and a component it is a heading of columns.
    let stated = Stated::of_title(&title);
    raw.stated = if stated.event.is_empty() { Stated::default() } else { stated };
    raw.title = title;
    told.complete(raw)
}
