//! map.csv: one row a cell, x fastest.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::column_set::ColumnSet;
use super::columns::{Column, Entry, Shown};
use super::listed::ListedCells;
use super::outcomes::{Outcomes, each_block, each_block_of};
use crate::scene::Grid;
use crate::scene::grid::Axis;
use crate::stepping::outcome::Outcome;
use crate::work::parallel;

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

/// Rows that a thread makes at once: some 500 kB of text, made in some milliseconds.
const ROWS: usize = 1 << 12;

/// Writes a table of some columns, its rows made on all cores.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    columns: ColumnSet,
    mut writer: impl Write,
) -> Result<(), csv::Error> {
    let mut head = csv::Writer::from_writer(&mut writer);
    let names = columns.of_table().map(|entry| entry.name);
    head.write_record(grid.axes().iter().map(Axis::key).chain(names))?;
    head.flush()?;
    drop(head);
    let read: Vec<Column> = columns.columns().collect();
    each_block(grid, outcomes, &read, |first, block| {
        let parts: Vec<_> = block.chunks(ROWS).collect();
        let part = |k: usize| rows(grid, columns, first + k * ROWS, parts[k]);
        for rows in parallel::each(parts.len(), 1, part) {
            writer.write_all(&rows?)?;
        }
        Ok(())
    })?;
    writer.flush()?;
    Ok(())
}

/// Writes the table of some cells, with their counts after the axes.
///
/// # Errors
/// Those of [`write()`].
pub fn write_list(
    listed: &ListedCells,
    columns: ColumnSet,
    writer: impl Write,
) -> Result<(), csv::Error> {
    let ListedCells { grid, cells, counts, outcomes, .. } = *listed;
    let mut table = csv::Writer::from_writer(writer);
    let names = grid.axes().iter().map(Axis::key).chain(counts.iter().map(|count| count.name));
    table.write_record(names.chain(columns.of_table().map(|entry| entry.name)))?;
    let read: Vec<Column> = columns.columns().collect();
    each_block_of(cells.len(), outcomes, &read, |first, block| {
        for (number, cell) in (first..).zip(block) {
            let at = grid.coordinates(cells[number]).map(|value| Field::Number(Number(value)));
            let counts = counts.iter().map(|count| Field::Count(count.values[number]));
            let fields = columns.of_table().map(|entry| Field::of(entry, cell));
            table.serialize(at.chain(counts).chain(fields).collect::<Vec<Field>>())?;
        }
        Ok(())
    })?;
    table.flush()?;
    Ok(())
}

/// A field of a row.
#[derive(Serialize)]
#[serde(untagged)]
enum Field {
    Name(&'static str),
    Count(u32),
    Number(Number),
    Time(Option<Number>),
}

impl Field {
    /// That of a cell in a column.
    fn of(entry: &Entry, cell: &Outcome) -> Field {
        match entry.shown(cell) {
            Shown::Code(_, name) => Field::Name(name),
            Shown::Count(count) => Field::Count(count),
            Shown::Number(number) => Field::Number(Number(number)),
            Shown::Time(time) => Field::Time(time.map(Number)),
        }
    }
}

/// Columns of a cell with its place in the grid.
struct Row<'a>(&'a Grid, ColumnSet, usize, &'a Outcome);

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Row(grid, columns, index, cell) = *self;
        let at = grid.coordinates(index).map(|value| Field::Number(Number(value)));
        serializer.collect_seq(at.chain(columns.of_table().map(|entry| Field::of(entry, cell))))
    }
}

/// The rows of some cells.
fn rows(
    grid: &Grid,
    columns: ColumnSet,
    first: usize,
    cells: &[Outcome],
) -> Result<Vec<u8>, csv::Error> {
    let mut table =
        csv::WriterBuilder::new().has_headers(false).from_writer(Vec::with_capacity(ROWS << 7));
    for (index, cell) in (first..).zip(cells) {
        table.serialize(Row(grid, columns, index, cell))?;
    }
    table.into_inner().map_err(|error| io::Error::other(error.to_string()).into())
}
