//! The columns of consecutive cells in memory, with numbers of the type of the sweep.

use std::ops::Range;

pub use super::cell_value::PENDING;
use super::column_set::ColumnSet;
use super::columns::{Column, Entry, TABLE};
pub use super::values::ColumnValues;
use super::values::{Slots, ValueType};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Outcome};
use crate::work::parallel;

/// Number of cells that are converted at once from outcomes to columns, or back: as many as a fast cache holds.
const AT_ONCE: usize = 1 << 8;

/// Cells that a thread fills at once: some 100 kB of columns, which no other thread writes to.
const A_THREAD: usize = 1 << 11;

/// Cells that are made before they go to their columns.
const FILLED: usize = 1 << 6;

/// Some values of a column that is held, with its description.
type Held<'a> = (&'static Entry, Slots<'a>);

/// The columns of consecutive cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    precision: Precision,
    /// One for each column, in the order of the table: empty where the column is not held, and its values are not known.
    columns: Vec<ColumnValues>,
}

/// Number of bytes that the columns of one cell take in memory.
pub fn bytes_a_cell(precision: Precision) -> usize {
    TABLE.iter().map(|entry| ValueType::of(entry.kind, precision).size()).sum()
}

impl Block {
    /// The columns of a given number of cells, none of which has run.
    pub fn pending(count: usize, precision: Precision) -> Block {
        Block::of(count, precision, ColumnSet::EVERY)
    }

    /// The same of some columns; those that every sweep holds are among them.
    pub(super) fn of(count: usize, precision: Precision, held: ColumnSet) -> Block {
        let column = |entry: &Entry| {
            let cells = if held.has(entry.column) { count } else { 0 };
            ColumnValues::all(entry.kind.pending(), ValueType::of(entry.kind, precision), cells)
        };
        Block { precision, columns: TABLE.iter().map(column).collect() }
    }

    /// The columns of outcomes. A cell that is [`Outcome::PENDING`] has not run.
    pub fn of_outcomes(outcomes: &[Outcome], precision: Precision) -> Block {
        let mut block = Block::pending(outcomes.len(), precision);
        let ran = |cell: &usize| outcomes[*cell] != Outcome::PENDING;
        let places: Vec<usize> = (0..outcomes.len()).filter(ran).collect();
        let ran: Vec<Outcome> = places.iter().map(|cell| outcomes[*cell]).collect();
        block.place(&places, &ran);
        block
    }

    /// Joins blocks, with numbers of the type of the first one. At most one column is held twice at a time, because each column
    /// leaves its block when it is taken.
    pub fn joined(mut blocks: Vec<Block>) -> Block {
        if let [_] = blocks[..] {
            return blocks.remove(0);
        }
        let precision = blocks.first().map_or(Precision::F32, Block::precision);
        let count = blocks.iter().map(Block::len).sum();
        let mut whole = Block::pending(0, precision);
        for (number, entry) in TABLE.iter().enumerate() {
            let of = ValueType::of(entry.kind, precision);
            if blocks.iter().any(|block| !block.is_empty() && block.columns[number].is_empty()) {
                continue;
            }
            let mut first = 0;
            whole.columns[number] = ColumnValues::all(0.0, of, count);
            for block in &mut blocks {
                let empty = ColumnValues::all(0.0, of, 0);
                let values = std::mem::replace(&mut block.columns[number], empty);
                let cells = first..first + values.len();
                first = cells.end;
                whole.columns[number].slots(cells).copy(&values, 0..values.len());
            }
        }
        whole
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.columns[Column::Status as usize].len()
    }

    /// True where there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number type of its columns.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// The columns that are held, with their descriptions.
    fn held(&mut self) -> impl Iterator<Item = (&'static Entry, &mut ColumnValues)> {
        TABLE.iter().zip(&mut self.columns).filter(|(_, values)| !values.is_empty())
    }

    /// The values of a column; none where it is not held.
    pub(super) fn values(&self, column: Column) -> &ColumnValues {
        &self.columns[column as usize]
    }

    /// Puts all values of a column in the place of those that it has.
    pub(super) fn replace(&mut self, column: Column, values: ColumnValues) {
        self.columns[column as usize] = values;
    }

    /// The class of a cell; unresolved where it has not run.
    pub fn class(&self, cell: usize) -> Class {
        match self.values(Column::Status).codes()[cell] {
            PENDING => Class::Unresolved,
            _ => Class::ALL[usize::from(self.values(Column::Outcome).codes()[cell])],
        }
    }

    /// The bytes of all columns, one after the other.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        self.columns.iter().flat_map(ColumnValues::to_bytes).collect()
    }

    /// The columns of so many cells from their bytes; none where these are too few, or have a code of nothing.
    pub(super) fn of_bytes(mut bytes: &[u8], cells: usize, precision: Precision) -> Option<Block> {
        let mut column = |kind| {
            let of = ValueType::of(kind, precision);
            let (column, rest) = bytes.split_at_checked(of.size() * cells)?;
            bytes = rest;
            Some(ColumnValues::of_bytes(column, of, cells)).filter(|values| values.have_names(kind))
        };
        let columns = TABLE.iter().map(|entry| column(entry.kind)).collect::<Option<Vec<_>>>()?;
        Some(Block { precision, columns })
    }

    /// Some of the columns, in the order of the table.
    pub fn into_columns(self, asked: ColumnSet) -> Vec<(Column, ColumnValues)> {
        let all = Column::ALL.into_iter().zip(self.columns);
        all.filter(|(column, _)| asked.has(*column)).collect()
    }

    /// Those of the given cells that have not run.
    pub fn pending_in(&self, cells: Range<usize>) -> usize {
        self.values(Column::Status).codes()[cells].iter().filter(|code| **code == PENDING).count()
    }

    /// The same of cells at some places.
    pub(super) fn pending_at(&self, places: &[usize]) -> usize {
        let codes = self.values(Column::Status).codes();
        places.iter().filter(|place| codes[**place] == PENDING).count()
    }

    /// The ranges of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        self.values(Column::Status).done()
    }

    /// Sets the fields of some columns in outcomes; the first outcome is that of the cell `first` of the block. A cell
    /// that has not run is [`Outcome::PENDING`].
    pub fn read(&self, first: usize, columns: &[Column], outcomes: &mut [Outcome]) {
        // The values of columns that are not held.
        let unknown = columns.iter().map(|column| {
            let (kind, absent) = (column.entry().kind, self.values(*column).is_empty());
            let of = ValueType::of(kind, self.precision);
            absent.then(|| ColumnValues::all(kind.filler(), of, AT_ONCE))
        });
        let unknown: Vec<Option<ColumnValues>> = unknown.collect();
        for (number, some) in outcomes.chunks_mut(AT_ONCE).enumerate() {
            for (column, unknown) in columns.iter().zip(&unknown) {
                let give = column.entry().give;
                match unknown {
                    Some(unknown) => give(unknown, 0, some),
                    None => give(self.values(*column), first + number * AT_ONCE, some),
                }
            }
            let codes = &self.values(Column::Status).codes()[first + number * AT_ONCE..];
            let pending = some.iter_mut().zip(codes).filter(|(_, code)| **code == PENDING);
            pending.for_each(|(cell, _)| *cell = Outcome::PENDING);
        }
    }

    /// The outcomes of all cells; [`Outcome::PENDING`] for those that have not run.
    pub fn to_outcomes(&self) -> Vec<Outcome> {
        let mut outcomes = vec![Outcome::PENDING; self.len()];
        self.read(0, &Column::ALL, &mut outcomes);
        outcomes
    }

    /// Takes outcomes, each to its place.
    pub fn place(&mut self, places: &[usize], outcomes: &[Outcome]) {
        let count = self.len();
        for (places, outcomes) in places.chunks(AT_ONCE).zip(outcomes.chunks(AT_ONCE)) {
            for (entry, values) in self.held() {
                (entry.put)(&mut values.slots(0..count), places, outcomes);
            }
        }
    }

    /// Takes the outcomes of cells from a place on.
    pub fn put(&mut self, first: usize, outcomes: &[Outcome]) {
        let places: Vec<usize> = (first..first + outcomes.len()).collect();
        self.place(&places, outcomes);
    }

    /// Takes the outcomes of a given number of cells from a place on, by all threads; `of` adds those of some cells, by their
    /// numbers among them, to a list. They stay in a fast cache until they are in their columns.
    pub fn fill(
        &mut self,
        first: usize,
        count: usize,
        of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync,
    ) {
        let cells = first..first + count;
        let mut whole: Vec<Held> =
            self.held().map(|(entry, values)| (entry, values.slots(cells.clone()))).collect();
        let cut = |from: usize| {
            let cells = from..(from + A_THREAD).min(count);
            let columns = whole.iter_mut();
            let slots = columns.map(|(entry, slots)| (*entry, slots.cut(cells.len()))).collect();
            (cells, slots)
        };
        let mut parts: Vec<(Range<usize>, Vec<Held>)> =
            (0..count).step_by(A_THREAD).map(cut).collect();
        let places: Vec<usize> = (0..A_THREAD).collect();
        parallel::each_slice(&mut parts, 1, |_, parts| {
            let (cells, slots) = &mut parts[0];
            let mut outcomes = Vec::with_capacity(FILLED);
            for from in cells.clone().step_by(FILLED) {
                outcomes.clear();
                of(from..(from + FILLED).min(cells.end), &mut outcomes);
                for (entry, slots) in &mut *slots {
                    (entry.put)(slots, &places[from - cells.start..], &outcomes);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stepping::outcome::Status;

    fn outcome(cell: usize) -> Outcome {
        let number = cell as f64 + 0.5;
        Outcome {
            class: Class::ALL[cell % 5],
            status: Status::ALL[cell % 4],
            impacts: cell as u32,
            t_end: number,
            t_uplift: Some(-number),
            zeta: 2.0 * number,
            friction: 3.0 * number,
            ..Outcome::PENDING
        }
    }

    /// All threads put every cell in its place, whatever the numbers of cells.
    #[test]
    fn all_threads_fill_what_one_puts() {
        for count in [1, FILLED, FILLED + 1, 2 * A_THREAD + 77] {
            let mut filled = Block::pending(count + 9, Precision::F64);
            filled.fill(5, count, |cells, outcomes| outcomes.extend(cells.map(outcome)));
            let mut expected = vec![Outcome::PENDING; count + 9];
            for cell in 0..count {
                expected[5 + cell] = outcome(cell);
            }
            assert_eq!(filled, Block::of_outcomes(&expected, Precision::F64));
        }
    }

    /// Outcomes are taken to their places, in any order.
    #[test]
    fn outcomes_are_placed() {
        for precision in [Precision::F32, Precision::F64] {
            let mut placed = Block::pending(9, precision);
            let mut expected = vec![Outcome::PENDING; 9];
            for (cell, place) in [8, 1, 2, 0].into_iter().enumerate() {
                placed.place(&[place], &[outcome(cell)]);
                expected[place] = outcome(cell);
            }
            placed.place(&[4, 3], &[outcome(4), outcome(5)]);
            (expected[4], expected[3]) = (outcome(4), outcome(5));
            assert_eq!(placed, Block::of_outcomes(&expected, precision));
        }
    }
}
