//! What a grid's axes are.

use serde_json::{Value, json};
use topple::{Axis, Grid};

/// The values of a grid's axes by their keys.
pub fn coordinates(grid: &Grid) -> Value {
    let values = |axis: &Axis| json!(axis.values.iter().collect::<Vec<f64>>());
    let axes = grid.axes().iter().map(|axis| (axis.key().to_string(), values(axis)));
    Value::Object(axes.collect())
}

/// Units and meanings of a grid's axes by their keys.
pub fn axes(grid: &Grid) -> Value {
    let one = |axis: &Axis| {
        let entry = axis.entry();
        (entry.key.to_string(), json!({ "unit": entry.unit, "meaning": entry.meaning }))
    };
    Value::Object(grid.axes().iter().map(one).collect())
}
