//! The list that comes with a download from PEER's NGA-West2 database, `_SearchResults.csv`: as it is, or as a
//! spreadsheet saves it again (quotes within quotes, commas to the last column).

use super::entry::Entry;
use super::files::Files;
use super::list::{positive, within};
use crate::sheet::{Rows, Sheet, TableError};
use topple::scene::record::text::printable;

/// How the heading of its table begins.
const HEADING: &str = "Result ID";

/// True of a list of PEER's.
pub fn matches(text: &str) -> bool {
    text.lines().any(is_heading) && text.contains("Horizontal-1 Acc. Filename")
}

/// True of the heading of its table.
fn is_heading(line: &str) -> bool {
    line.trim_start().trim_start_matches('"').starts_with(HEADING)
}

/// A field without the blanks and the quotes around it; nothing where there are dashes alone.
fn plain(field: &str) -> &str {
    let field = field.trim_matches(|c: char| c.is_whitespace() || c == '"');
    if field.chars().all(|c| c == '-') { "" } else { field }
}

/// The entries of a list: of each of its records both horizontals, with the vertical.
pub fn read(text: &str, name: &str, files: &Files) -> Result<Vec<Entry>, TableError> {
    let words = || text.split_inclusive('\n').take_while(|line| !is_heading(line));
    let start: usize = words().map(str::len).sum();
    let empty = || TableError::whole("its table is empty; give the list of a download");
    let is_words = |name: &str| plain(name).to_lowercase().ends_with("name");
    let table = Rows::of(&text[start..], 1 + words().count(), false)?;
    let sheet = Sheet::of(table, is_words)?.ok_or_else(empty)?;
    let column = |name: &str| {
        let place = sheet.names.iter().position(|heading| plain(heading) == name);
        place.ok_or_else(|| {
            let problem =
                format!("its table has no column '{name}'; give the list of the download");
            TableError::at(sheet.line, problem)
        })
    };
    let (number, event, station) =
        (column("Record Sequence Number")?, column("Earthquake Name")?, column("Station Name")?);
    let (year, scale) = (column("Year")?, column("Scale Factor")?);
    let horizontals =
        [column("Horizontal-1 Acc. Filename")?, column("Horizontal-2 Acc. Filename")?];
    let vertical = column("Vertical Acc. Filename")?;
    let mut entries = Vec::new();
    // What follows the table is no table.
    for row in sheet.loose_rows().map_while(Result::ok) {
        let field = |column: usize| plain(sheet.cell(&row, column).text);
        // A table of spectra follows after an empty line or a line of words.
        if field(number).parse::<u64>().is_err() {
            break;
        }
        let factor = match field(scale) {
            "" => None,
            _ => positive(sheet.cell(&row, scale))?,
        };
        within(row.line, entries.len())?;
        for listed in horizontals.map(field).into_iter().filter(|name| !name.is_empty()) {
            let there = files.find(listed, name);
            let mut entry = Entry::of(there.as_deref().unwrap_or(listed));
            let year = field(year);
            entry.event =
                printable(&[field(event), year].join(if year.is_empty() { "" } else { ", " }));
            entry.station = printable(field(station));
            entry.missing = there.err();
            let up = field(vertical);
            if !up.is_empty() {
                let found = files.find(up, name);
                entry.missing =
                    entry.missing.or(found.as_ref().err().map(|why| format!("its vertical {why}")));
                entry.vertical = found.ok();
            }
            if let Some(factor) = factor.filter(|factor| *factor != 1.0) {
                entry.scale = factor;
                entry.notes.push(format!("scaled by {factor}, the list's factor"));
            }
            entries.push(entry);
        }
    }
    if entries.is_empty() {
        return Err(empty());
    }
    Ok(entries)
}
