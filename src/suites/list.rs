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

/// The entries of a list; its files lie beside it, or below.
pub fn read(text: &str, files: &Files) -> Result<Vec<Entry>, String> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let headings = reader.headers().map_err(|error| error.to_string())?;
    if !headings.iter().any(|heading| heading == "horizontal") {
        return Err(
            "line 1: no column 'horizontal'; give id,horizontal,vertical,dt,units,scale,weight, or the list of a \
             download from PEER"
                .into(),
        );
    }
    let mut entries: Vec<Entry> = Vec::new();
    for (number, row) in reader.deserialize::<Row>().enumerate() {
        let at = number + 2;
        let row = row.map_err(|error| match error.kind() {
            csv::ErrorKind::Deserialize { err, .. } => format!("line {at}: {err}"),
            _ => format!("line {at}: {error}"),
        })?;
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
