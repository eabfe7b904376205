//! What the library knows of parameters and columns, for help and labels.

use pyo3::prelude::*;
use serde_json::json;
use topple::Column;
use topple::scene::parameters::Section;
use topple::scene::{description, keys};

use crate::keywords::{METHOD, REFINING, SETTINGS};
use crate::uncertain::UNCERTAIN;

/// The parameters of a scene as JSON: see [`description`].
#[pyfunction]
pub fn parameters() -> String {
    json!(description::parameters()).to_string()
}

/// The keywords that are no numbers, as JSON: those of each section of a scene, under `settings` how it is run,
/// under `method` how a motion is integrated, under `refining` how its map is refined, and under `uncertain` what is not
/// known of it.
#[pyfunction]
pub fn words() -> String {
    let mut words: serde_json::Map<String, serde_json::Value> = Section::ALL
        .iter()
        .map(|section| (section.key().to_string(), json!(keys::words(*section))))
        .collect();
    words.insert("settings".into(), json!(SETTINGS));
    words.insert("method".into(), json!(METHOD));
    words.insert("refining".into(), json!(REFINING));
    words.insert("uncertain".into(), json!(UNCERTAIN));
    json!(words).to_string()
}

/// The columns of a map as JSON: name, unit, meaning.
#[pyfunction]
pub fn columns() -> String {
    let entries = Column::ALL.iter().map(|column| {
        let entry = column.entry();
        json!({ "name": entry.name, "unit": entry.unit, "meaning": entry.meaning })
    });
    json!(entries.collect::<Vec<_>>()).to_string()
}
