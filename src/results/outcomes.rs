//! Where a map's outcomes are read from: memory, or a disk that holds more.

use std::borrow::Cow;
use std::io;
use std::ops::Range;
use std::path::Path;

use super::block::Block;
use super::columns::Column;
use super::values::{ColumnValues, ValueType};
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;

/// Cells that are read at once by what goes through all of them.
pub const BLOCK: usize = 1 << 16;

/// The outcomes of a grid, in its order.
pub trait Outcomes: Sync {
    /// The outcomes of some cells. Only the columns asked for are sure to be filled in.
    ///
    /// # Errors
    /// Errors of the disk.
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>>;

    /// The values of a column of some cells, numbers of a type.
    ///
    /// # Errors
    /// Errors of the disk.
    fn column(
        &self,
        cells: Range<usize>,
        column: Column,
        precision: Precision,
    ) -> io::Result<ColumnValues> {
        let places: Vec<usize> = (0..cells.len()).collect();
        let entry = column.entry();
        let of = ValueType::of(entry.kind, precision);
        let mut values = ColumnValues::all(0.0, of, cells.len());
        let outcomes = self.read(cells, &[column])?;
        (entry.put)(&mut values.slots(0..outcomes.len()), &places, &outcomes);
        Ok(values)
    }

    /// All columns of a given number of cells, numbers of a type; outcomes in memory give theirs away.
    ///
    /// # Errors
    /// Errors of the disk.
    fn into_block(self: Box<Self>, cells: usize, precision: Precision) -> io::Result<Block> {
        let mut block = Block::pending(cells, precision);
        for first in (0..cells).step_by(BLOCK) {
            block.put(first, &self.read(first..(first + BLOCK).min(cells), &Column::ALL)?);
        }
        Ok(block)
    }

    /// Hears that a folder has another name now.
    fn moved(&mut self, from: &Path, to: &Path) {
        let _ = (from, to);
    }
}

impl Outcomes for Block {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        Block::read(self, cells.start, columns, &mut outcomes);
        Ok(Cow::Owned(outcomes))
    }
}

impl Outcomes for [Outcome] {
    fn read(&self, cells: Range<usize>, _: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        Ok(Cow::Borrowed(&self[cells]))
    }
}

impl Outcomes for Vec<Outcome> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.as_slice().read(cells, columns)
    }
}

/// Goes through some columns of a given number of outcomes; `see` is handed block after block with the number of its first
/// cell.
///
/// # Errors
/// Those of reading, and of `see`.
pub fn each_block(
    count: usize,
    outcomes: &dyn Outcomes,
    columns: &[Column],
    mut see: impl FnMut(usize, &[Outcome]) -> io::Result<()>,
) -> io::Result<()> {
    for first in (0..count).step_by(BLOCK) {
        let block = outcomes.read(first..(first + BLOCK).min(count), columns)?;
        see(first, &block)?;
    }
    Ok(())
}
