//! suite.csv: one row per motion, with its measures and the decisions of the reader.

use std::io::{self, Write};

use super::columns::{TableColumn, name, names, number};
use super::read::Suite;
use topple::scene::record::rounded;

/// Digits of the numbers: records have fewer.
const DIGITS: usize = 7;

/// The columns.
pub const COLUMNS: [TableColumn; 15] = [
    name("id", "name of the motion"),
    name("event", "earthquake"),
    name("station", "station"),
    name("horizontal", "file of the horizontal component"),
    name("vertical", "file of the vertical component"),
    number("dt", "s", "time between samples"),
    number("duration", "s", "time of the last sample"),
    number("pga_h", "m/s²", "largest horizontal acceleration"),
    number("pga_v", "m/s²", "largest vertical acceleration"),
    number("pgv", "m/s", "largest horizontal velocity"),
    number("arias", "m/s", "Arias intensity of the horizontal component"),
    number("cav", "m/s", "cumulative absolute velocity of the horizontal component"),
    number("d5_75", "s", "time between 5 % and 75 % of the Arias intensity"),
    number("d5_95", "s", "time between 5 % and 95 % of the Arias intensity"),
    name("notes", "what was decided, or why there is no motion"),
];

/// Writes the table; of a line without a motion the numbers are empty, and the notes say why.
///
/// # Errors
/// Those of the writer.
pub fn write(suite: &Suite, writer: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(names(&COLUMNS))?;
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
