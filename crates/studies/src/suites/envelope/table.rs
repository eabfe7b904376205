//! envelope.csv and zeta.csv.

use std::io::{self, Write};

use super::Envelope;
use crate::suites::columns::{self, TableColumn, number};
use topple::results::csv::Number;

/// The columns of envelope.csv after the axes.
pub const COLUMNS: [TableColumn; 14] = [
    number("records", "1", "motions"),
    number("standing", "1", "share of the motions under which the block stands"),
    number("overturned", "1", "share of the motions under which it overturns"),
    number("rocked", "1", "share of the motions under which it rocks and stands"),
    number("max_u_50", "m", "median of max |u| over the motions under which it stands"),
    number("max_u_84", "m", "84th percentile of max |u| over the motions under which it stands"),
    number("max_u_100", "m", "largest max |u| over the motions under which it stands"),
    number("stroke_v_50", "m", "median of the stroke of v over the motions under which it stands"),
    number(
        "stroke_v_84",
        "m",
        "84th percentile of the stroke of v over the motions under which it stands",
    ),
    number("stroke_v_100", "m", "largest stroke of v over the motions under which it stands"),
    number("feasible", "1", "1 where all limits are kept"),
    number(
        "reserve",
        "1",
        "steps of the grid, along all axes at once, to the nearest cell that does not keep all limits; 0 in such a cell, empty \
         where there is none",
    ),
    number("overturned_low", "1", "lower end of the interval of 95 % of overturned"),
    number("overturned_high", "1", "upper end of the interval of 95 % of overturned"),
];

/// Those of zeta.csv.
pub const ZETA_COLUMNS: [TableColumn; 3] = [
    number("zeta_50", "1", "median of the rocking index over the motions under which it stands"),
    number(
        "zeta_84",
        "1",
        "84th percentile of the rocking index over the motions under which it stands",
    ),
    number("zeta_100", "1", "largest rocking index over the motions under which it stands"),
];

/// Writes envelope.csv: the axes, and what there is of each cell.
///
/// # Errors
/// Those of the writer.
pub fn write(envelope: &Envelope, writer: impl Write) -> io::Result<()> {
    let grid = &envelope.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let further = envelope.settings.columns.iter().flat_map(|column| columns::further(*column));
    let further = further.map(|(name, ..)| name);
    let names = columns::keys(grid).chain(columns::names(&COLUMNS)).map(String::from);
    table.write_record(names.chain(further))?;
    let records = envelope.records();
    let known = |value: f64| (!value.is_nan()).then_some(Number(value));
    for (index, cell) in envelope.cells.iter().enumerate() {
        let axes = columns::values(grid, index);
        let shares = [cell.standing, cell.overturned, cell.rocked].map(Number);
        let (u, v) = (cell.max_u.map(known), cell.stroke_v.map(known));
        let within = cell.overturned_within.map(|end| end.map(Number));
        let feasible = u8::from(cell.feasible);
        let further: Vec<_> = envelope.further(index).flatten().map(known).collect();
        table.serialize((axes, records, shares, u, v, feasible, cell.reserve, within, further))?;
    }
    table.flush()
}

/// Writes zeta.csv: the axes, and percentiles of the rocking index over the motions under which the block stands.
///
/// # Errors
/// Those of the writer.
pub fn write_zeta(envelope: &Envelope, writer: impl Write) -> io::Result<()> {
    let grid = &envelope.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns::keys(grid).chain(columns::names(&ZETA_COLUMNS)))?;
    for (index, cell) in envelope.cells.iter().enumerate() {
        let axes = columns::values(grid, index);
        table
            .serialize((axes, cell.zeta.map(|value| (!value.is_nan()).then_some(Number(value)))))?;
    }
    table.flush()
}
