//! What a file of arrays holds, whatever its format: the axes, the columns with an index for each axis, and what they are as
//! JSON (`about`).

use std::io;

use serde_json::Value;

use super::about::Source;
use super::chunk;
use super::columns::{Column, Entry};
use super::listed::{CELL, FileCells};
use super::outcomes::{BLOCK, Outcomes};
use super::values::{ValueType, bytes_of};
use super::zarr::PROVED;

/// Name of the array that tells what the others are.
pub(super) const ABOUT: &str = "about";

/// The type of an array's elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Element {
    /// True or false, a byte each.
    Bool,
    /// Values of a column.
    Value(ValueType),
    /// Numbers of cells.
    Cell,
}

impl Element {
    /// Bytes of an element.
    pub(super) fn size(self) -> usize {
        match self {
            Element::Bool => 1,
            Element::Value(of) => of.size(),
            Element::Cell => size_of::<u64>(),
        }
    }
}

/// Hands the bytes of an array's elements over to a writer.
pub(super) type Fill<'a> = &'a mut dyn FnMut(&mut dyn io::Write) -> io::Result<()>;

/// A file of arrays that is written array after array.
pub(super) trait ArrayFile {
    /// Adds an array whose last index is the fastest one. `write` is to hand over the bytes of all its elements, the lowest byte
    /// of each first.
    fn array(&mut self, name: &str, of: Element, shape: &[u64], write: Fill) -> io::Result<()>;

    /// Adds a text.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()>;
}

/// Writes the axes of some cells, the requested columns, the numbers and counts of a list, and what all these are: column by
/// column, never a whole one in memory.
pub(super) fn write(
    cells: FileCells,
    outcomes: &dyn Outcomes,
    source: Source,
    file: &mut dyn ArrayFile,
) -> io::Result<()> {
    for axis in cells.grid.axes() {
        let values: Vec<f64> = axis.values.iter().collect();
        let of = Element::Value(ValueType::F64);
        list(axis.key(), of, &bytes_of(&values, f64::to_le_bytes), file)?;
    }
    let axes = cells.grid.axes().iter().rev().map(|axis| axis.count() as u64);
    let shape = cells.list.map_or_else(|| axes.collect(), |list| vec![list.cells.len() as u64]);
    let columns = source.columns.entries().map(|entry| (entry.name, entry));
    let status = source.columns.has(Column::Status).then(|| Column::Status.entry());
    for (name, entry) in columns.chain(status.map(|status| (PROVED, status))) {
        column(cells, outcomes, source, (name, entry), &shape, file)?;
    }
    if let Some(of) = cells.list {
        let numbers = bytes_of(of.cells, |cell| (cell as u64).to_le_bytes());
        list(CELL, Element::Cell, &numbers, file)?;
    }
    for count in cells.counts() {
        let of = Element::Value(ValueType::U32);
        list(count.name, of, &bytes_of(&count.values, u32::to_le_bytes), file)?;
    }
    file.text(ABOUT, &Value::Object(cells.about(source)).to_string())
}

/// Writes an array of one index that is in memory.
fn list(name: &str, of: Element, bytes: &[u8], file: &mut dyn ArrayFile) -> io::Result<()> {
    file.array(name, of, &[(bytes.len() / of.size()) as u64], &mut |to| to.write_all(bytes))
}

/// Writes the array of a column.
fn column(
    cells: FileCells,
    outcomes: &dyn Outcomes,
    source: Source,
    (name, entry): (&str, &Entry),
    shape: &[u64],
    file: &mut dyn ArrayFile,
) -> io::Result<()> {
    let of = match name {
        PROVED => Element::Bool,
        _ => Element::Value(ValueType::of(entry.kind, source.precision)),
    };
    let count = cells.count();
    file.array(name, of, shape, &mut |to| {
        for first in (0..count).step_by(BLOCK) {
            let block = first..(first + BLOCK).min(count);
            let values = outcomes.column(block, entry.column, source.precision)?;
            to.write_all(&chunk::in_array(name, entry.column, values).to_bytes())?;
        }
        Ok(())
    })
}
