//! suite.csv: one row per motion, with its measures and the decisions of the reader.

use super::read::Suite;
use super::{Entry, Motion};
use crate::table::{Columns, Field, Table, TableColumn, number};
use topple::scene::record::rounded;

/// Digits of the numbers: records have fewer.
const DIGITS: usize = 7;

/// A line of a suite, and its motion, or why it has none.
type Row = (Entry, Result<Motion, String>);

/// suite.csv; of a line without a motion the numbers are empty, and the notes say why.
pub fn suite(suite: &Suite) -> Table<'_> {
    fn measure<'a>(
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        value: fn(&Motion) -> f64,
    ) -> TableColumn<&'a Row> {
        number(name, unit, meaning, move |(_, motion): &&Row| {
            Some(Field::Rounded(rounded(value(motion.as_ref().ok()?), DIGITS)))
        })
    }
    let cav = "cumulative absolute velocity of the horizontal component";
    let columns = Columns::<&Row>::new()
        .text("id", "name of the motion", |(entry, _)| entry.id.clone())
        .text("event", "earthquake", |(entry, _)| entry.event.clone())
        .text("station", "station", |(entry, _)| entry.station.clone())
        .text("horizontal", "file of the horizontal component", |(entry, _)| {
            entry.horizontal.clone()
        })
        .text("vertical", "file of the vertical component", |(entry, _)| entry.vertical.clone())
        .with([
            measure("dt", "s", "time between samples", |of| of.pair.dt),
            measure("duration", "s", "time of the last sample", |of| of.pair.duration()),
            measure("pga_h", "m/s²", "largest horizontal acceleration", |of| of.measures.pga_h),
            measure("pga_v", "m/s²", "largest vertical acceleration", |of| of.measures.pga_v),
            measure("pgv", "m/s", "largest horizontal velocity", |of| of.measures.pgv),
            measure("arias", "m/s", "Arias intensity of the horizontal component", |of| {
                of.measures.arias
            }),
            measure("cav", "m/s", cav, |of| of.measures.cav),
            measure("d5_75", "s", "time between 5 % and 75 % of the Arias intensity", |of| {
                of.measures.d5_75
            }),
            measure("d5_95", "s", "time between 5 % and 95 % of the Arias intensity", |of| {
                of.measures.d5_95
            }),
        ])
        .text("notes", "what was decided, or why there is no motion", |(entry, motion)| {
            let left_out = motion.as_ref().err().map(|reason| format!("left out: {reason}"));
            left_out.into_iter().chain(entry.notes.iter().cloned()).collect::<Vec<_>>().join("; ")
        });
    Table::of_rows(columns, suite.rows.iter().enumerate())
}
