//! history.csv, the motion of one cell, and events.csv, its switches.

use std::io::Write;

use topple::backend::history::{Event, FORCE_COLUMNS, Forces, OfForces, Row};
use topple::results::csv::Number;

/// Names of the columns.
pub const COLUMNS: [&str; 9] = ["t", "mode", "u", "du", "v", "dv", "z", "phi", "dphi"];

/// Columns that are written where they are requested, behind the others: which of [`FORCE_COLUMNS`].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MoreColumns([bool; FORCE_COLUMNS.len()]);

impl std::str::FromStr for MoreColumns {
    type Err = String;

    fn from_str(text: &str) -> Result<MoreColumns, String> {
        let mut wanted = [false; FORCE_COLUMNS.len()];
        for name in text.split(',').map(str::trim) {
            match FORCE_COLUMNS.iter().position(|(own, _)| *own == name) {
                Some(place) => wanted[place] = true,
                None if name == "all" => wanted = [true; FORCE_COLUMNS.len()],
                // They are there in any case.
                None if COLUMNS.contains(&name) => {}
                None => {
                    let names = FORCE_COLUMNS.map(|(name, _)| name);
                    return Err(format!(
                        "{name:?} is no column; give all, or some of {}",
                        names.join(", ")
                    ));
                }
            }
        }
        Ok(MoreColumns(wanted))
    }
}

impl From<MoreColumns> for String {
    fn from(columns: MoreColumns) -> String {
        columns.columns().map(|(name, _)| name).collect::<Vec<_>>().join(",")
    }
}

impl MoreColumns {
    /// True where none is requested.
    pub fn is_empty(&self) -> bool {
        self.columns().next().is_none()
    }

    fn columns(&self) -> impl Iterator<Item = (&'static str, OfForces)> {
        FORCE_COLUMNS
            .into_iter()
            .zip(self.0)
            .filter(|(_, wanted)| *wanted)
            .map(|(column, _)| column)
    }
}

/// The fields of a row behind its time and what stands between.
fn numbers(row: &Row) -> [Number; 7] {
    [row.u, row.du, row.v, row.dv, row.z, row.phi, row.dphi].map(Number)
}

/// Writes the table; `forces` are those of the rows, where columns of them are requested.
pub fn write(
    rows: &[Row],
    (more, forces): (&MoreColumns, &[Forces]),
    writer: impl Write,
) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(COLUMNS.into_iter().chain(more.columns().map(|(name, _)| name)))?;
    for (at, row) in rows.iter().enumerate() {
        let of = |forces: &Forces| -> Vec<Number> {
            more.columns().map(|(_, of)| Number(of(forces))).collect()
        };
        let more = forces.get(at).map(of).unwrap_or_default();
        table.serialize((Number(row.t), row.mode, numbers(row), more))?;
    }
    table.flush()?;
    Ok(())
}

/// Writes the events.
pub fn write_events(events: &[(Event, Row)], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(["t", "event"].into_iter().chain(COLUMNS[1..].iter().copied()))?;
    for (event, row) in events {
        table.serialize((Number(row.t), event.word(), row.mode, numbers(row)))?;
    }
    table.flush()?;
    Ok(())
}
