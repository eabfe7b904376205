//! A list of one's own: a CSV with the columns `id,horizontal,vertical,dt,units,scale,weight`, of which `horizontal`
//! alone must be there, and others that it may have.

use std::collections::BTreeSet;

use serde::Deserialize;

use super::delimited;
use super::entry::{Entry, MOST_FACTOR};
use super::files::Files;
use topple::scene::record::text::printable;
use topple::scene::record::zips::MOST_FILES;
use topple::scene::record::{Baseline, Units};
use topple::scene::shown::shown;
use topple::written::Written;

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

/// A row of the list, its numbers as they are written.
#[derive(Deserialize)]
struct Row {
    id: Option<String>,
    event: Option<String>,
    station: Option<String>,
    horizontal: String,
    vertical: Option<String>,
    horizontal_channel: Option<String>,
    vertical_channel: Option<String>,
    dt: Option<String>,
    units: Option<String>,
    baseline: Option<String>,
    scale: Option<String>,
    weight: Option<String>,
}

/// The number of a column in a line; none where nothing is written.
fn positive(at: usize, column: &str, text: Option<&str>) -> Result<Option<f64>, String> {
    let Some(text) = text.filter(|text| !text.is_empty()) else { return Ok(None) };
    match delimited::number(text) {
        Some(number) if number > MOST_FACTOR => {
            Err(format!("line {at}: {column} {text} is above {MOST_FACTOR:e}"))
        }
        Some(number) if number > 0.0 => Ok(Some(number)),
        _ => Err(format!("line {at}: {column} {text} must be a positive number")),
    }
}

/// The units of a line; none where nothing is written.
fn units(at: usize, text: Option<&str>) -> Result<Option<Units>, String> {
    let Some(text) = text.filter(|text| !text.is_empty()) else { return Ok(None) };
    match Units::named(text) {
        Some(units) => Ok(Some(units)),
        None => Err(format!("line {at}: units {text} are not known; give g, m/s2, cm/s2 or gal")),
    }
}

/// What is subtracted from the velocity of a line; none where nothing is written.
fn baseline(at: usize, text: Option<&str>) -> Result<Option<Baseline>, String> {
    let Some(text) = text.filter(|text| !text.is_empty()) else { return Ok(None) };
    let known = Baseline::of_key(text);
    known
        .map(Some)
        .ok_or_else(|| format!("line {at}: baseline {text} is not known; give none or line"))
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

/// The columns of a heading, in small letters.
fn headings(text: &str) -> Vec<String> {
    let heading = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let names = heading.split(delimited::separator(heading));
    names.map(|name| name.trim().trim_matches('"').trim().to_lowercase()).collect()
}

/// True of a list: its heading has a column `horizontal`, and not the measures of a table that was made of a suite.
pub fn matches(text: &str) -> bool {
    let names = headings(&delimited::plain(text));
    let has = |wanted| names.iter().any(|name| name == wanted);
    has("horizontal") && !has("arias")
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
pub fn read(text: &str, name: &str, files: &Files) -> Result<Vec<Entry>, String> {
    let text = &*delimited::plain(text);
    let mut written = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
    let (heading, first) = written.next().unwrap_or(("", 1));
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .delimiter(delimited::separator(heading) as u8)
        .from_reader(text.as_bytes());
    let names = reader.headers().map_err(|error| error.to_string())?;
    let names: csv::StringRecord = names.iter().map(|name| name.trim().to_lowercase()).collect();
    if !names.iter().any(|heading| heading == "horizontal") {
        return Err(format!(
            "line {first}: no column 'horizontal'; give id,horizontal,vertical,dt,units,scale,weight with commas between, \
             or the list of a download from PEER"
        ));
    }
    if let Some(other) = names.iter().find(|name| !COLUMNS.contains(name) && !name.is_empty()) {
        return Err(format!(
            "line {first}: no column is called '{other}'; there are {}",
            COLUMNS.join(",")
        ));
    }
    let (mut entries, mut ids) = (Vec::<Entry>::new(), BTreeSet::new());
    let mut rows = reader.into_records();
    loop {
        let at = delimited::line(text, rows.reader().position());
        let Some(row) = rows.next() else { break };
        within(at, entries.len())?;
        // Spreadsheets leave separators at the ends of rows; what stands there has no name.
        let unnamed = row
            .iter()
            .flatten()
            .zip(&names)
            .find(|(field, name)| name.is_empty() && !field.is_empty());
        if let Some((field, _)) = unnamed {
            return Err(format!(
                "line {at}: '{}' stands in a column without a name; name it, one of {}",
                shown(field),
                COLUMNS.join(",")
            ));
        }
        let row = row.and_then(|row| row.deserialize::<Row>(Some(&names)));
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
        let there = files.find(&row.horizontal, name);
        let mut entry = Entry::of(there.as_deref().unwrap_or(&row.horizontal));
        entry.missing = there.err();
        match row.vertical.as_deref().filter(|name| !name.is_empty()) {
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
        entry.baseline = baseline(at, row.baseline.as_deref())?;
        entry.channels = [row.horizontal_channel, row.vertical_channel]
            .map(|channel| channel.filter(|channel| !channel.is_empty()));
        // Files of one name in two folders get ids of their own.
        let id = row.id.as_deref().map(printable);
        if let Some(id) = id.filter(|id| !id.is_empty()) {
            if !ids.insert(id.clone()) {
                let id = shown(&id);
                return Err(format!("line {at}: the id {id} stands twice; give each its own"));
            }
            entry.id = id;
        }
        entry.event = row.event.as_deref().map_or(String::new(), printable);
        entry.station = row.station.as_deref().map_or(String::new(), printable);
        entries.push(entry);
    }
    if entries.is_empty() {
        return Err("it has no line below its heading; give a motion a line".into());
    }
    Ok(entries)
}
