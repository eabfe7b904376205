//! map.csv: one row a cell, x fastest.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::column_set::ColumnSet;
use super::columns::{Column, Entry, Shown};
use super::listed::FileCells;
use super::outcomes::{Outcomes, each_block};
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

/// Writes a table of some columns, its rows made on all cores; the counts of a list follow the axes.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write<'a>(
    cells: impl Into<FileCells<'a>>,
    outcomes: &dyn Outcomes,
    columns: ColumnSet,
    mut writer: impl Write,
) -> Result<(), csv::Error> {
    let cells: FileCells = cells.into();
    let mut head = csv::Writer::from_writer(&mut writer);
    let axes = cells.grid.axes().iter().map(Axis::key);
    let names = axes.chain(cells.counts().iter().map(|count| count.name));
    head.write_record(names.chain(columns.of_table().map(|entry| entry.name)))?;
    head.flush()?;
    drop(head);
    let read: Vec<Column> = columns.columns().collect();
    each_block(cells.count(), outcomes, &read, |first, block| {
        let parts: Vec<_> = block.chunks(ROWS).collect();
        let part = |k: usize| rows(cells, columns, first + k * ROWS, parts[k]);
        for rows in parallel::each(parts.len(), 1, part) {
            writer.write_all(&rows?)?;
        }
        Ok(())
    })?;
    writer.flush()?;
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

/// Columns of a cell with its place in the grid and its counts.
struct Row<'a>(FileCells<'a>, ColumnSet, usize, &'a Outcome);

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Row(cells, columns, number, cell) = *self;
        let at = cells.grid.coordinates(cells.cell(number));
        let at = at.map(|value| Field::Number(Number(value)));
        let counts = cells.counts().iter().map(|count| Field::Count(count.values[number]));
        let fields = columns.of_table().map(|entry| Field::of(entry, cell));
        serializer.collect_seq(at.chain(counts).chain(fields))
    }
}

/// The rows of some cells.
fn rows(
    cells: FileCells,
    columns: ColumnSet,
    first: usize,
    block: &[Outcome],
) -> Result<Vec<u8>, csv::Error> {
    let mut table =
        csv::WriterBuilder::new().has_headers(false).from_writer(Vec::with_capacity(ROWS << 7));
    for (number, cell) in (first..).zip(block) {
        table.serialize(Row(cells, columns, number, cell))?;
    }
    table.into_inner().map_err(|error| io::Error::other(error.to_string()).into())
}
