//! map.csv: one row a cell, x fastest.

use std::io::{self, Write};

use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::outcomes::{Column, Outcomes, each_block};
use crate::scene::Grid;
use crate::scene::grid::Axis;
use crate::stepping::outcome::Outcome;

/// Columns after those of the axes.
pub const COLUMNS: [&str; 14] = [
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
    "stroke_v",
    "min_contact",
    "friction_demand",
    "status",
];

/// A number in as few digits as tell it from its neighbours: those of f32 where it came from one.
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let single = self.0 as f32;
        if f64::from(single) == self.0 {
            return serializer.serialize_f32(single);
        }
        serializer.serialize_f64(self.0)
    }
}

/// Rows that a thread makes at once.
const ROWS: usize = 1 << 12;

/// Writes the table, its rows made on all cores.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    mut writer: impl Write,
) -> Result<(), csv::Error> {
    let mut head = csv::Writer::from_writer(&mut writer);
    head.write_record(grid.axes().iter().map(Axis::key).chain(COLUMNS))?;
    head.flush()?;
    drop(head);
    each_block(grid, outcomes, &Column::ALL, |first, block| {
        let made: Vec<Vec<u8>> = block
            .par_chunks(ROWS)
            .enumerate()
            .map(|(k, cells)| rows(grid, first + k * ROWS, cells))
            .collect::<Result<_, _>>()?;
        made.iter().try_for_each(|rows| writer.write_all(rows))
    })?;
    writer.flush()?;
    Ok(())
}

/// The rows of some cells.
fn rows(grid: &Grid, first: usize, cells: &[Outcome]) -> Result<Vec<u8>, csv::Error> {
    let mut table =
        csv::WriterBuilder::new().has_headers(false).from_writer(Vec::with_capacity(ROWS << 7));
    for (index, cell) in (first..).zip(cells) {
        let at: Vec<Number> = grid.coordinates(index).map(Number).collect();
        table.serialize((
            at,
            cell.class.name(),
            cell.impacts,
            cell.uplifts,
            Number(cell.t_end),
            cell.t_uplift.map(Number),
            Number(cell.zeta),
            Number(cell.max_phi_left),
            Number(cell.max_phi_right),
            Number(cell.max_u),
            Number(cell.max_v),
            Number(cell.stroke_v),
            Number(cell.min_contact),
            Number(cell.friction),
            cell.status.name(),
        ))?;
    }
    table.into_inner().map_err(|error| io::Error::other(error.to_string()).into())
}
