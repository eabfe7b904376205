//! suite.csv: a line a motion, with its measures and what was decided.

use std::io::{self, Write};

use super::read::Suite;
use crate::scene::record::rounded;

/// Digits of the numbers: records have fewer.
const DIGITS: usize = 7;

/// The columns.
pub const COLUMNS: [&str; 15] = [
    "id",
    "event",
    "station",
    "horizontal",
    "vertical",
    "dt",
    "duration",
    "pga_h",
    "pga_v",
    "pgv",
    "arias",
    "cav",
    "d5_75",
    "d5_95",
    "notes",
];

/// Writes the table; of a line without a motion the numbers are empty, and the notes say why.
///
/// # Errors
/// Those of the writer.
pub fn write(suite: &Suite, writer: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(COLUMNS)?;
    for (entry, motion) in &suite.rows {
        let vertical = entry.vertical.clone().unwrap_or_default();
        let named = [&entry.id, &entry.event, &entry.station, &entry.horizontal, &vertical];
        let numbers = motion.as_ref().map_or([const { String::new() }; 9], |motion| {
            let (pair, m) = (&motion.pair, &motion.measures);
            [pair.dt, pair.duration(), m.pga_h, m.pga_v, m.pgv, m.arias, m.cav, m.d5_75, m.d5_95]
                .map(|number| rounded(number, DIGITS).to_string())
        });
        let mut notes = entry.notes.clone();
        if let Err(reason) = motion {
            notes.insert(0, format!("left out: {reason}"));
        }
        let notes = [notes.join("; ")];
        table.write_record(named.into_iter().chain(&numbers).chain(&notes))?;
    }
    table.flush()
}
