//! envelope.csv and zeta.csv.

use std::io::{self, Write};

use super::Envelope;
use crate::suites::columns::{self, TableColumn, known, number};
use crate::suites::grid_table::GridTable;
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
pub(super) fn write(envelope: &Envelope, writer: &mut dyn Write) -> io::Result<()> {
    let further = columns::further_names(&envelope.settings.columns);
    let names = columns::names(&COLUMNS).map(String::from).chain(further);
    let mut table = GridTable::begin(&envelope.sweep.grid, writer, names)?;
    let records = envelope.records();
    for (index, cell) in envelope.cells.iter().enumerate() {
        let shares = [cell.standing, cell.overturned, cell.rocked].map(Number);
        let (u, v) = (cell.max_u.map(known), cell.stroke_v.map(known));
        let within = cell.overturned_within.map(|end| end.map(Number));
        let feasible = u8::from(cell.feasible);
        let further: Vec<_> = envelope.further(index).flatten().map(known).collect();
        let own = (records, shares, u, v, feasible, cell.reserve, within);
        table.row(index, (own, further))?;
    }
    table.end()
}

/// Writes zeta.csv: the axes, and percentiles of the rocking index over the motions under which the block stands.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_zeta(envelope: &Envelope, writer: &mut dyn Write) -> io::Result<()> {
    let names = columns::names(&ZETA_COLUMNS);
    let mut table = GridTable::begin(&envelope.sweep.grid, writer, names)?;
    for (index, cell) in envelope.cells.iter().enumerate() {
        table.row(index, cell.zeta.map(known))?;
    }
    table.end()
}
