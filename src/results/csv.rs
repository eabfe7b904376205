//! map.csv: one row a cell, x fastest.

use std::io::Write;

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
            writer.write_all(&rows)?;
        }
        Ok(())
    })?;
    writer.flush()?;
    Ok(())
}

/// The rows of some cells. No name has a character that would have to be quoted.
fn rows(cells: FileCells, columns: ColumnSet, first: usize, block: &[Outcome]) -> Vec<u8> {
    let entries: Vec<&Entry> = columns.of_table().collect();
    let mut table = Vec::with_capacity(ROWS << 7);
    for (number, cell) in (first..).zip(block) {
        cells.grid.coordinates(cells.cell(number)).for_each(|at| put_number(&mut table, at));
        cells.counts().iter().for_each(|count| put_count(&mut table, count.values[number]));
        for entry in &entries {
            match entry.shown(cell) {
                Shown::Code(_, name) => put(&mut table, name),
                Shown::Count(count) => put_count(&mut table, count),
                Shown::Number(number) => put_number(&mut table, number),
                Shown::Time(Some(time)) => put_number(&mut table, time),
                Shown::Time(None) => put(&mut table, ""),
            }
        }
        // The comma after the last field. A grid has an axis at least.
        table.pop();
        table.push(b'\n');
    }
    table
}

/// Adds a field and a comma.
fn put(row: &mut Vec<u8>, field: &str) {
    row.extend_from_slice(field.as_bytes());
    row.push(b',');
}

/// Adds a number as [`Number`] is written, and a comma.
fn put_number(row: &mut Vec<u8>, number: f64) {
    let (mut buffer, single) = (ryu::Buffer::new(), number as f32);
    let text =
        if f64::from(single) == number { buffer.format(single) } else { buffer.format(number) };
    put(row, text);
}

/// Adds a number of events and a comma.
fn put_count(row: &mut Vec<u8>, count: u32) {
    put(row, itoa::Buffer::new().format(count));
}
