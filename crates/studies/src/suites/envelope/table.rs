//! envelope.csv and zeta.csv.

use super::{CellEnvelope, Envelope};
use crate::suites::columns::{further, of_standing};
use crate::table::{Columns, Table};

/// A cell, and the percentiles of the further columns.
type Row<'a> = (&'a CellEnvelope, Vec<[f64; 3]>);

/// envelope.csv: the axes, and what there is of each cell.
pub(super) fn envelope(envelope: &Envelope) -> Table<'_> {
    let records = envelope.records();
    let standing = "share of the motions under which the block stands";
    let overturned = "share of the motions under which it overturns";
    let rocked = "share of the motions under which it rocks and stands";
    let reserve = "steps of the grid, along all axes at once, to the nearest cell that does not keep all limits; 0 in such a cell, \
                   empty where there is none";
    let [low, high] =
        ["lower", "upper"].map(|end| format!("{end} end of the interval of 95 % of overturned"));
    let columns = Columns::<Row>::new()
        .number("records", "1", "motions", move |_| records)
        .number("standing", "1", standing, |(cell, _)| cell.standing)
        .number("overturned", "1", overturned, |(cell, _)| cell.overturned)
        .number("rocked", "1", rocked, |(cell, _)| cell.rocked)
        .with(of_standing(("max_u", "m"), ("", "max |u|"), |(cell, _): &Row| cell.max_u))
        .with(of_standing(("stroke_v", "m"), ("the ", "stroke of v"), |(cell, _): &Row| {
            cell.stroke_v
        }))
        .number("feasible", "1", "1 where all limits are kept", |(cell, _)| cell.feasible)
        .number("reserve", "1", reserve, |(cell, _)| cell.reserve)
        .number("overturned_low", "1", low, |(cell, _)| cell.overturned_within[0])
        .number("overturned_high", "1", high, |(cell, _)| cell.overturned_within[1])
        .with(further(&envelope.settings.columns, |(_, further): &Row, k| further[k]));
    let rows = envelope.cells.iter().enumerate();
    let rows = rows.map(|(index, cell)| (index, (cell, envelope.further(index).collect())));
    Table::of_cells(&envelope.sweep.grid, columns, rows)
}

/// zeta.csv: the axes, and percentiles of the rocking index over the motions under which the block stands.
pub(super) fn zeta(envelope: &Envelope) -> Table<'_> {
    let zeta = |cell: &&CellEnvelope| cell.zeta;
    let columns = Columns::new().with(of_standing(("zeta", "1"), ("the ", "rocking index"), zeta));
    Table::of_cells(&envelope.sweep.grid, columns, envelope.cells.iter().enumerate())
}
