//! map.csv: one row a cell, x fastest.

use std::io::{self, Write};

use rayon::prelude::*;
use serde::{Serialize, Serializer};

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
const BLOCK: usize = 1 << 12;
/// Blocks that are made before they are written.
const BLOCKS: usize = 16;

/// Writes the table, its rows made on all cores.
///
/// # Errors
/// Those of the writer.
pub fn write(map: &Map, mut writer: impl Write) -> Result<(), csv::Error> {
    let mut head = csv::Writer::from_writer(&mut writer);
    head.write_record([map.grid.x.key, map.grid.y.key].iter().chain(&COLUMNS))?;
    head.flush()?;
    drop(head);
    let starts: Vec<usize> = (0..map.outcomes.len()).step_by(BLOCK).collect();
    for some in starts.chunks(BLOCKS) {
        let blocks: Vec<Vec<u8>> =
            some.par_iter().map(|&start| rows(map, start)).collect::<Result<_, _>>()?;
        for block in blocks {
            writer.write_all(&block)?;
        }
    }
    writer.flush()?;
    Ok(())
}

/// The rows of a block of cells.
fn rows(map: &Map, start: usize) -> Result<Vec<u8>, csv::Error> {
    let mut table =
        csv::WriterBuilder::new().has_headers(false).from_writer(Vec::with_capacity(BLOCK << 7));
    let end = (start + BLOCK).min(map.outcomes.len());
    for (index, cell) in (start..end).zip(&map.outcomes[start..end]) {
        let (x, y) = map.grid.coordinates(index);
        table.serialize((
            Number(x),
            Number(y),
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
            Number(cell.min_contact),
            Number(cell.friction),
            cell.status.name(),
        ))?;
    }
    table.into_inner().map_err(|error| io::Error::other(error.to_string()).into())
}
