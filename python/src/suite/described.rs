//! What is told of tables and sweeps, as JSON, and tables as text.

use std::fmt::Display;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use serde_json::{Value, json};
use topple::results::about;
use topple::results::columns::Column;
use topple_studies::suites::columns::{self, ColumnUnit, TableColumn};
use topple_studies::{Suite, SuiteSweep};

use crate::axes::{axes, coordinates};

/// Units and meanings of columns by their names; `of_measure` is the unit of the intensity measure.
pub fn described(columns: &[TableColumn], of_measure: &str) -> Value {
    let one = |column: &TableColumn| {
        let unit = match column.unit {
            ColumnUnit::Name => "",
            ColumnUnit::Of(unit) => unit,
            ColumnUnit::OfMeasure => of_measure,
        };
        (column.name.to_string(), json!({ "unit": unit, "meaning": column.meaning }))
    };
    Value::Object(columns.iter().map(one).collect())
}

/// The same with those of a map's columns that are told, too.
pub fn described_with(columns: &[TableColumn], further: &[Column]) -> Value {
    let mut all = described(columns, "");
    for (name, unit, meaning) in further.iter().flat_map(|column| columns::further(*column)) {
        all[name] = json!({ "unit": unit, "meaning": meaning });
    }
    all
}

/// What motions there were, and how they were swept.
pub fn told(sweep: &SuiteSweep, suite: &Suite) -> Value {
    let ids: Vec<&str> = suite.motions().map(|(entry, _)| entry.id.as_str()).collect();
    json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "motions": ids,
        "sweep_seconds": sweep.seconds,
        "verification": sweep.verified,
    })
}

/// The same with the scene and its grid.
pub fn told_of_grid(sweep: &SuiteSweep, suite: &Suite) -> Value {
    let mut about = told(sweep, suite);
    about["scene"] = json!(sweep.scene);
    about["index"] = json!(about::index(&sweep.grid));
    about["axes"] = json!(axes(&sweep.grid));
    about["coordinates"] = json!(coordinates(&sweep.grid));
    about
}

/// What is written to a table.
pub fn text<E: Display>(write: impl FnOnce(&mut Vec<u8>) -> Result<(), E>) -> PyResult<String> {
    let mut bytes = Vec::new();
    write(&mut bytes).map_err(|error| PyOSError::new_err(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
