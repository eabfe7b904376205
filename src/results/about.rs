//! What the arrays of map.npz and map.zarr are, as JSON: axes, columns, units, scene, version.

use serde_json::{Map, Value, json};

use super::column_set::ColumnSet;
use super::columns::STATUS_NAMES;
use crate::model::precision::Precision;
use crate::scene::grid::Axis;
use crate::scene::{Grid, Scene};
use crate::stepping::outcome::Class;

/// What arrays are of.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The sweep's numbers: those of the columns are of the same type.
    pub precision: Precision,
    /// The requested columns.
    pub columns: ColumnSet,
}

impl Source<'_> {
    /// Units and meanings of the arrays of a grid, the names of the codes, the scene, the version.
    pub fn about(&self, grid: &Grid) -> Map<String, Value> {
        let units = |unit: &str, meaning: &str| json!({ "unit": unit, "meaning": meaning });
        let axes = grid.axes().iter().map(|axis| {
            let entry = axis.entry();
            (entry.key.to_string(), units(entry.unit, entry.meaning))
        });
        let columns =
            self.columns.entries().map(|e| (e.name.to_string(), units(e.unit, e.meaning)));
        let entries = [
            ("program", json!("topple")),
            ("version", json!(env!("CARGO_PKG_VERSION"))),
            ("index", json!(index(grid))),
            ("outcome", json!(Class::ALL.map(Class::name))),
            ("status", json!(STATUS_NAMES)),
            ("axes", Value::Object(axes.collect())),
            ("columns", Value::Object(columns.collect())),
            ("scene", json!(self.scene)),
        ];
        // Without folders: the same map is the same file wherever its record lies.
        let record = self
            .scene
            .excitation
            .provenance()
            .map(|files| ("record", json!(files.without_folders())));
        entries.into_iter().chain(record).map(|(key, value)| (key.to_string(), value)).collect()
    }
}

/// The keys of a grid's axes in the order of the arrays' indices: the first axis last.
pub fn index(grid: &Grid) -> Vec<&'static str> {
    grid.axes().iter().rev().map(Axis::key).collect()
}
