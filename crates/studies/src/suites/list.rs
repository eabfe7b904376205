//! A list of one's own: a CSV with the columns `id,horizontal,vertical,dt,units,scale,weight`, of which `horizontal`
//! alone must be there.

use std::collections::BTreeSet;

use serde::Deserialize;
use serde::de::value::{self, StrDeserializer};

use super::entry::{Entry, MOST_FACTOR};
use super::files::Files;
use topple::scene::record::Units;
use topple::scene::record::zips::MOST_FILES;

/// The columns that a list may have.
const COLUMNS: [&str; 9] =
    ["id", "event", "station", "horizontal", "vertical", "dt", "units", "scale", "weight"];

/// A row of the list, its numbers as they are written.
#[derive(Deserialize)]
struct Row {
    id: Option<String>,
    event: Option<String>,
    station: Option<String>,
    horizontal: String,
    vertical: Option<String>,
    dt: Option<String>,
    units: Option<String>,
    scale: Option<String>,
    weight: Option<String>,
}

/// The number of a column in a line; none where nothing is written.
fn positive(at: usize, column: &str, text: Option<&str>) -> Result<Option<f64>, String> {
    let Some(text) = text.filter(|text| !text.is_empty()) else { return Ok(None) };
    match text.parse::<f64>() {
        Ok(number) if number > MOST_FACTOR => {
            Err(format!("line {at}: {column} {text} is above {MOST_FACTOR:e}"))
        }
        Ok(number) if number > 0.0 => Ok(Some(number)),
        _ => Err(format!("line {at}: {column} {text} must be a positive number")),
    }
}

/// The units of a line; none where nothing is written.
fn units(at: usize, text: Option<&str>) -> Result<Option<Units>, String> {
    let Some(text) = text.filter(|text| !text.is_empty()) else { return Ok(None) };
    match Units::deserialize(StrDeserializer::<value::Error>::new(text)) {
        Ok(units) => Ok(Some(units)),
        Err(_) => Err(format!("line {at}: units {text} are not known; give g, m/s2, cm/s2 or gal")),
    }
}

/// Most lines of a list: each may have files of its own, of which no more are looked at.
const MOST: usize = MOST_FILES;

/// Refuses a line after which there are more entries than a list may have.
pub(super) fn within(at: usize, entries: usize) -> Result<(), String> {
    match entries < MOST {
        true => Ok(()),
        false => Err(format!("line {at}: more than {MOST} motions; give several lists")),
    }
}

/// True of a list: its heading has a column `horizontal`, and not the measures of a table that was made of a suite.
pub fn matches(text: &str) -> bool {
    let heading = text.trim_start_matches('\u{feff}').lines().next().unwrap_or_default();
    let has = |wanted| heading.split(',').any(|name| name.trim() == wanted);
    has("horizontal") && !has("arias")
}

/// The entries of a list; its files lie beside it, or below.
pub fn read(text: &str, files: &Files) -> Result<Vec<Entry>, String> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let headings = reader.headers().map_err(|error| error.to_string())?;
    if !headings.iter().any(|heading| heading == "horizontal") {
        return Err(
            "line 1: no column 'horizontal'; give id,horizontal,vertical,dt,units,scale,weight with commas between, or \
             the list of a download from PEER"
                .into(),
        );
    }
    if let Some(other) = headings.iter().find(|heading| !COLUMNS.contains(heading)) {
        return Err(format!(
            "line 1: no column is called '{other}'; there are {}",
            COLUMNS.join(",")
        ));
    }
    // Empty lines are no rows.
    let written = text.lines().enumerate().filter(|(_, line)| !line.is_empty());
    let lines: Vec<usize> = written.map(|(number, _)| number + 1).collect();
    let (mut entries, mut ids) = (Vec::<Entry>::new(), BTreeSet::new());
    for (number, row) in reader.deserialize::<Row>().enumerate() {
        let at = lines.get(number + 1).copied().unwrap_or(number + 2);
        within(at, entries.len())?;
        let row = row.map_err(|error| match error.kind() {
            csv::ErrorKind::Deserialize { err, .. } => format!("line {at}: {err}"),
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                format!("line {at}: {len} fields where the heading has {expected_len}")
            }
            _ => format!("line {at}: {error}"),
        })?;
        if row.horizontal.is_empty() {
            return Err(format!("line {at}: no horizontal file; give one"));
        }
        let there = files.find(&row.horizontal);
        let mut entry = Entry::of(there.unwrap_or(&row.horizontal));
        if there.is_none() {
            entry.missing =
                Some(format!("{} is in the list and not among the files", row.horizontal));
        }
        match row.vertical.as_deref().filter(|name| !name.is_empty()) {
            None => {
                entry.horizontal_alone = true;
                entry
                    .notes
                    .push("no vertical in the list: the ground does not move vertically".into());
            }
            Some(up) => {
                entry.vertical = files.find(up).map(String::from);
                if entry.vertical.is_none() && entry.missing.is_none() {
                    entry.missing = Some(format!("its vertical {up} is not among the files"));
                }
            }
        }
        entry.dt = positive(at, "dt", row.dt.as_deref())?;
        entry.scale = positive(at, "scale", row.scale.as_deref())?.unwrap_or(1.0);
        entry.weight = positive(at, "weight", row.weight.as_deref())?.unwrap_or(1.0);
        if entry.scale != 1.0 {
            entry.notes.push(format!("scaled by {}, the list's factor", entry.scale));
        }
        if entry.weight != 1.0 {
            entry.notes.push(format!("weight {}", entry.weight));
        }
        entry.units = units(at, row.units.as_deref())?;
        if let Some(id) = row.id.filter(|id| !id.is_empty()) {
            entry.id = id;
        }
        if !ids.insert(entry.id.clone()) {
            return Err(format!("line {at}: the id {} stands twice; give each its own", entry.id));
        }
        entry.event = row.event.unwrap_or_default();
        entry.station = row.station.unwrap_or_default();
        entries.push(entry);
    }
    if entries.is_empty() {
        return Err("it has no line below its heading; give a motion a line".into());
    }
    Ok(entries)
}
