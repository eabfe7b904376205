//! history.csv, the motion of one cell, and events.csv, its switches.

use std::io::Write;

use topple::backend::history::{Event, Forces, Row};
use topple::results::csv::Number;

/// Names of the columns.
pub const COLUMNS: [&str; 9] = ["t", "mode", "u", "du", "v", "dv", "z", "phi", "dphi"];

/// A column that is written where it is asked for, behind the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct More(usize);

/// What a column has of the forces at a row.
type OfForces = fn(&Forces) -> f64;

/// Those columns.
const MORE: [(&str, OfForces); 7] = [
    ("ground_h", |forces| forces.ground_h),
    ("ground_v", |forces| forces.ground_v),
    ("acc_plate", |forces| forces.acc_plate),
    ("acc_block", |forces| forces.acc_block),
    ("acc_block_v", |forces| forces.acc_block_v),
    ("n", |forces| forces.normal),
    ("s", |forces| forces.shear),
];

/// Columns that are asked for, in the order of the table.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MoreColumns(Vec<More>);

impl std::str::FromStr for MoreColumns {
    type Err = String;

    fn from_str(text: &str) -> Result<MoreColumns, String> {
        let mut wanted = [false; MORE.len()];
        for name in text.split(',').map(str::trim) {
            match MORE.iter().position(|(own, _)| *own == name) {
                Some(place) => wanted[place] = true,
                None if name == "all" => wanted = [true; MORE.len()],
                // They are there in any case.
                None if COLUMNS.contains(&name) => {}
                None => {
                    let names: Vec<&str> = MORE.iter().map(|(name, _)| *name).collect();
                    return Err(format!(
                        "{name:?} is no column; give all, or some of {}",
                        names.join(", ")
                    ));
                }
            }
        }
        let places = wanted.iter().enumerate().filter(|(_, wanted)| **wanted);
        Ok(MoreColumns(places.map(|(place, _)| More(place)).collect()))
    }
}

impl MoreColumns {
    /// True where none is asked for.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The fields of a row behind its time and what stands between.
fn numbers(row: &Row) -> [Number; 7] {
    [row.u, row.du, row.v, row.dv, row.z, row.phi, row.dphi].map(Number)
}

/// Writes the table; `forces` are those of the rows, where columns of them are asked for.
///
/// # Errors
/// Those of the writer.
pub fn write(
    rows: &[Row],
    (more, forces): (&MoreColumns, &[Forces]),
    writer: impl Write,
) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(COLUMNS.iter().copied().chain(more.0.iter().map(|more| MORE[more.0].0)))?;
    for (at, row) in rows.iter().enumerate() {
        let of = |forces: &Forces| -> Vec<Number> {
            more.0.iter().map(|more| Number(MORE[more.0].1(forces))).collect()
        };
        let more = forces.get(at).map(of).unwrap_or_default();
        table.serialize((Number(row.t), row.mode, numbers(row), more))?;
    }
    table.flush()?;
    Ok(())
}

/// Writes the events.
///
/// # Errors
/// Those of the writer.
pub fn write_events(events: &[(Event, Row)], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(["t", "event"].into_iter().chain(COLUMNS[1..].iter().copied()))?;
    for (event, row) in events {
        table.serialize((Number(row.t), event.word(), row.mode, numbers(row)))?;
    }
    table.flush()?;
    Ok(())
}
