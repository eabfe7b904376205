//! A list of one's own: a CSV with the columns `id,horizontal,vertical,dt,units,scale,weight`, of which `horizontal`
//! alone must be there, and others that it may have.

use std::collections::BTreeSet;

use super::entry::{Entry, MOST_FACTOR};
use super::files::Files;
use crate::sheet::{Cell, Rows, Sheet, TableError};
use topple::Written;
use topple::scene::record::text::printable;
use topple::scene::record::zips::MOST_FILES;
use topple::scene::record::{Baseline, Units};
use topple::scene::shown::shown;

/// The columns that a list may have.
const COLUMNS: [&str; 12] = [
    "id",
    "event",
    "station",
    "horizontal",
    "vertical",
    "horizontal_channel",
    "vertical_channel",
    "dt",
    "units",
    "baseline",
    "scale",
    "weight",
];

/// Those of numbers; in the others words stand.
const NUMBERS: [&str; 3] = ["dt", "scale", "weight"];

/// The number of a cell; none where nothing is written.
pub(super) fn positive(cell: Cell) -> Result<Option<f64>, TableError> {
    let text = shown(cell.text);
    match cell.number()? {
        Some(number) if number > MOST_FACTOR => {
            Err(cell.refused(format!("{text} is above {MOST_FACTOR:e}")))
        }
        Some(number) if number > 0.0 => Ok(Some(number)),
        Some(_) => Err(cell.refused(format!("{text} must be a positive number"))),
        None => Ok(None),
    }
}

/// What the word of a cell stands for, of `known` ones; none where nothing is written.
fn word<T>(cell: Cell, of: fn(&str) -> Option<T>, known: &str) -> Result<Option<T>, TableError> {
    if cell.text.is_empty() {
        return Ok(None);
    }
    let refused = || cell.refused(format!("{} is not known; give {known}", shown(cell.text)));
    of(cell.text).map(Some).ok_or_else(refused)
}

/// Most lines of a list: each may have files of its own, of which no more are looked at.
const MOST: usize = MOST_FILES;

/// Refuses a line after which there are more entries than a list may have.
pub(super) fn within(at: usize, entries: usize) -> Result<(), TableError> {
    match entries < MOST {
        true => Ok(()),
        false => Err(TableError::at(at, format!("more than {MOST} motions; give several lists"))),
    }
}

/// The columns of a heading, in small letters; none of a text without one.
fn headings(text: &str) -> Vec<String> {
    let first = Rows::of(text, 1, false).ok().and_then(|mut rows| rows.next()?.ok());
    first.map_or_else(Vec::new, |row| row.cells.iter().map(|name| name.to_lowercase()).collect())
}

/// True of a list: its heading has a column `horizontal`, and not the measures of a table that was made of a suite. Below comments, which
/// records have, too, all its columns are those of a list.
pub fn matches(text: &str) -> bool {
    let names = headings(text);
    let has = |wanted| names.iter().any(|name| name == wanted);
    let is_column = |name: &String| name.is_empty() || COLUMNS.contains(&name.as_str());
    has("horizontal")
        && !has("arias")
        && (!text.trim_start().starts_with('#') || names.iter().all(is_column))
}

/// True of a list whose fields are parted otherwise, or whose name is no list's: all words of its heading are columns, and
/// `horizontal` is among them.
pub(super) fn is_meant(text: &str) -> bool {
    let heading = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let apart = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '|' | '"');
    let words = heading.split(apart).filter(|word| !word.is_empty()).map(str::to_lowercase);
    let words: Vec<String> = words.collect();
    let is_column = |word: &String| COLUMNS.contains(&word.as_str());
    words.iter().all(is_column) && words.iter().any(|word| word == "horizontal")
}

/// True of a table that `topple suite` has made.
pub fn is_measures(text: &str) -> bool {
    let names = headings(text);
    ["horizontal", "arias", "d5_95"].iter().all(|own| names.iter().any(|name| name == own))
}

/// The entries of a list; its files lie beside it, or below.
pub fn read(text: &str, name: &str, files: &Files) -> Result<Vec<Entry>, TableError> {
    let empty = || TableError::whole("it has no line below its heading; give a motion a line");
    let is_words = |name: &str| !NUMBERS.contains(&&*name.to_lowercase());
    let sheet = Sheet::of(Rows::of(text, 1, false)?, is_words)?.ok_or_else(empty)?;
    let names: Vec<String> = sheet.names.iter().map(|name| name.to_lowercase()).collect();
    let columns = || COLUMNS.join(",");
    if !names.iter().any(|heading| heading == "horizontal") {
        return Err(TableError::at(
            sheet.line,
            "no column 'horizontal'; give id,horizontal,vertical,dt,units,scale,weight with commas between, \
             or the list of a download from PEER",
        ));
    }
    let is_unknown = |name: &&String| !name.is_empty() && !COLUMNS.contains(&name.as_str());
    if let Some(other) = names.iter().find(is_unknown) {
        let problem = format!("no column is called '{}'; there are {}", shown(other), columns());
        return Err(TableError::at(sheet.line, problem));
    }
    let sheet = sheet.without_numbered_comments(text)?;
    let (mut entries, mut ids) = (Vec::<Entry>::new(), BTreeSet::new());
    for row in sheet.rows() {
        let row = row?;
        within(row.line, entries.len())?;
        let cell = |column: &str| {
            let at = names.iter().position(|name| name == column);
            sheet.cell(&row, at.unwrap_or(usize::MAX))
        };
        let text = |column: &str| Some(cell(column).text).filter(|text| !text.is_empty());
        let horizontal = text("horizontal")
            .ok_or_else(|| TableError::at(row.line, "no horizontal file; give one"))?;
        let there = files.find(horizontal, name);
        let mut entry = Entry::of(there.as_deref().unwrap_or(horizontal));
        entry.missing = there.err();
        match text("vertical") {
            None => {
                entry.horizontal_alone = true;
                entry
                    .notes
                    .push("no vertical in the list: the ground does not move vertically".into());
            }
            Some(up) => {
                let found = files.find(up, name);
                entry.missing =
                    entry.missing.or(found.as_ref().err().map(|why| format!("its vertical {why}")));
                entry.vertical = found.ok();
            }
        }
        entry.dt = positive(cell("dt"))?;
        entry.scale = positive(cell("scale"))?.unwrap_or(1.0);
        entry.weight = positive(cell("weight"))?.unwrap_or(1.0);
        if entry.scale != 1.0 {
            entry.notes.push(format!("scaled by {}, the list's factor", entry.scale));
        }
        if entry.weight != 1.0 {
            entry.notes.push(format!("weight {}", entry.weight));
        }
        entry.units = word(cell("units"), Units::named, "g, m/s2, cm/s2 or gal")?;
        entry.baseline = word(cell("baseline"), Baseline::of_key, "none or line")?;
        entry.channels =
            ["horizontal_channel", "vertical_channel"].map(|key| text(key).map(String::from));
        // Files of one name in two folders get ids of their own.
        let id = text("id").map(printable);
        if let Some(id) = id.filter(|id| !id.is_empty()) {
            if !ids.insert(id.clone()) {
                let problem = format!("the id {} stands twice; give each its own", shown(&id));
                return Err(TableError::at(row.line, problem));
            }
            entry.id = id;
        }
        [entry.event, entry.station] =
            ["event", "station"].map(|key| text(key).map_or_else(String::new, printable));
        entries.push(entry);
    }
    if entries.is_empty() { Err(empty()) } else { Ok(entries) }
}
