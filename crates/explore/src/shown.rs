//! What a map of the page can show: outcomes, or a number as a shade, each with its title and the ends of its scale.

use serde_json::{Value, json};
use topple::results::columns::Column;

/// Columns of a suite that are shares of its motions, with their titles.
const SHARES: [(&str, &str); 3] = [
    ("overturned", "share of motions that overturn the block"),
    ("standing", "share of motions under which it stands"),
    ("rocked", "share of motions under which it rocks"),
];

/// Of a column: its title, and the ends of its scale where these are fixed.
fn of(column: Column) -> Value {
    let (title, ends) = match column {
        Column::Zeta => ("ζ = max |φ| / α", Some([0.0, 1.0])),
        Column::MaxU => ("max |u| [m]", None),
        Column::MaxV => ("max |v| [m]", None),
        Column::StrokeV => ("max |v + g/ω_v²| [m]", None),
        Column::MinContact => ("min N/M [m/s²]", Some([0.0, 10.0])),
        Column::Friction => ("friction needed, max |S|/N", Some([0.0, 1.0])),
        other => (other.entry().name, None),
    };
    json!({ "name": column.entry().name, "title": title, "ends": ends, "share": false })
}

/// What maps of single motions and of suites show, the first one where nothing is chosen.
pub fn shown() -> Value {
    let outcomes = json!({ "name": "outcome", "title": "outcomes", "ends": null, "share": false });
    let shares = SHARES.map(
        |(name, title)| json!({ "name": name, "title": title, "ends": [0.0, 1.0], "share": true }),
    );
    let columns = [
        Column::Zeta,
        Column::MaxU,
        Column::MaxV,
        Column::StrokeV,
        Column::MinContact,
        Column::Friction,
    ];
    let map: Vec<Value> = std::iter::once(outcomes).chain(columns.map(of)).collect();
    let strokes = [Column::MaxU, Column::StrokeV].map(of);
    let suite: Vec<Value> = shares.into_iter().chain(strokes).collect();
    json!({ "map": map, "suite": suite })
}
