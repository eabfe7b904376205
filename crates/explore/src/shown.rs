//! What a map of the page can show: outcomes, or a number as a shade, each with its title and the ends of its scale.

use serde_json::{Value, json};
use topple::results::columns::Column;
use topple_pictures::map::figure::fields::{self, Field};

/// Columns of a suite that are shares of its motions, with their titles.
const SHARES: [(&str, &str); 3] = [
    ("overturned", "share of motions that overturn the block"),
    ("standing", "share of motions under which it stands"),
    ("rocked", "share of motions under which it rocks"),
];

/// Of a column: its title, and the ends of its scale where these are fixed.
fn of(field: &Field) -> Value {
    let (title, ends) = match field.column {
        Column::Friction => ("friction needed, max |S|/N", Some((0.0, 1.0))),
        _ => (field.label, field.ends),
    };
    json!({ "name": field.column.entry().name, "title": title, "ends": ends, "share": false })
}

/// What maps of single motions and of suites show, the first one where nothing is chosen.
pub fn shown() -> Value {
    let outcomes = json!({ "name": "outcome", "title": "outcomes", "ends": null, "share": false });
    let shares = SHARES.map(
        |(name, title)| json!({ "name": name, "title": title, "ends": [0.0, 1.0], "share": true }),
    );
    let map: Vec<Value> = std::iter::once(outcomes).chain(fields::all().map(of)).collect();
    let strokes =
        fields::all().filter(|field| matches!(field.column, Column::MaxU | Column::StrokeV));
    let suite: Vec<Value> = shares.into_iter().chain(strokes.map(of)).collect();
    json!({ "map": map, "suite": suite })
}
