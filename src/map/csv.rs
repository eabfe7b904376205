//! map.csv: one row a cell, x fastest.

use std::io::Write;

use super::Map;

/// Columns after the two of the axes.
pub const COLUMNS: [&str; 13] = [
    "outcome",
    "impacts",
    "uplifts",
    "t_end",
    "t_uplift",
    "zeta",
    "max_phi_left",
    "max_phi_right",
    "max_u",
    "max_v",
    "min_contact",
    "friction",
    "status",
];

/// A number in as few digits as tell it from its neighbours: those of f32 where it came from one.
pub(super) fn number(value: f64) -> String {
    let single = value as f32;
    let (text, scientific) = if f64::from(single) == value {
        (single.to_string(), format!("{single:e}"))
    } else {
        (value.to_string(), format!("{value:e}"))
    };
    if scientific.len() < text.len() { scientific } else { text }
}

/// Writes the table.
///
/// # Errors
/// Those of the writer.
pub fn write(map: &Map, writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record([map.grid.x.key, map.grid.y.key].iter().chain(&COLUMNS))?;
    for (index, cell) in map.outcomes.iter().enumerate() {
        let (x, y) = map.grid.coordinates(index);
        table.write_record([
            number(x),
            number(y),
            cell.class.name().to_string(),
            cell.impacts.to_string(),
            cell.uplifts.to_string(),
            number(cell.t_end),
            cell.t_uplift.map(number).unwrap_or_default(),
            number(cell.zeta),
            number(cell.max_phi_left),
            number(cell.max_phi_right),
            number(cell.max_u),
            number(cell.max_v),
            number(cell.min_contact),
            number(cell.friction),
            cell.status.name().to_string(),
        ])?;
    }
    table.flush()?;
    Ok(())
}
