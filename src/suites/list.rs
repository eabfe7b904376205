//! A list of one's own: a CSV with the columns `id,horizontal,vertical,dt,units,scale,weight`, of which `horizontal`
//! alone must be there.

use serde::Deserialize;

use super::entry::Entry;
use super::files::Files;
use crate::scene::record::Units;

/// A row of the list.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    id: Option<String>,
    event: Option<String>,
    station: Option<String>,
    horizontal: String,
    vertical: Option<String>,
    dt: Option<f64>,
    units: Option<Units>,
    scale: Option<f64>,
    weight: Option<f64>,
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
    let mut entries: Vec<Entry> = Vec::new();
    for (number, row) in reader.deserialize::<Row>().enumerate() {
        let at = number + 2;
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
        let positive = |name: &str, value: Option<f64>| match value {
            Some(value) if !(value.is_finite() && value > 0.0) => {
                Err(format!("line {at}: {name} {value} must be a positive number"))
            }
            value => Ok(value),
        };
        entry.dt = positive("dt", row.dt)?;
        entry.scale = positive("scale", row.scale)?.unwrap_or(1.0);
        entry.weight = positive("weight", row.weight)?.unwrap_or(1.0);
        if entry.scale != 1.0 {
            entry.notes.push(format!("scaled by {}, the list's factor", entry.scale));
        }
        if entry.weight != 1.0 {
            entry.notes.push(format!("weight {}", entry.weight));
        }
        entry.units = row.units;
        if let Some(id) = row.id.filter(|id| !id.is_empty()) {
            entry.id = id;
        }
        if entries.iter().any(|other| other.id == entry.id) {
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
