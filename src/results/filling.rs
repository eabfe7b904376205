//! How the columns of a block are filled: with outcomes, by one thread or by all, and with the cells of another
//! block.

use std::ops::Range;

use super::block::{AT_ONCE, Block, with_columns};
use super::cell_value::{CellValue, Stored};
use super::columns::{Column, ColumnType, Columns, Slots, ValueOf, with_column};
use super::element::ColumnNumber;
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;
use crate::work::parallel;

/// Cells that a thread fills at once: some 100 kB of columns, which no other thread writes to.
const A_THREAD: usize = 1 << 11;

/// Cells that are made before they go to their columns.
const FILLED: usize = 1 << 6;

impl Block {
    /// The columns of outcomes. A cell that is [`Outcome::PENDING`] has not run.
    pub fn of_outcomes(outcomes: &[Outcome], precision: Precision) -> Block {
        let mut block = Block::pending(outcomes.len(), precision);
        let pending = |outcome: &Outcome| *outcome == Outcome::PENDING;
        let mut first = 0;
        for run in outcomes.chunk_by(|one, next| pending(one) == pending(next)) {
            if !pending(&run[0]) {
                block.put(first, run);
            }
            first += run.len();
        }
        block
    }

    /// Takes the outcomes of cells from a place on.
    pub fn put(&mut self, first: usize, outcomes: &[Outcome]) {
        let cells = first..first + outcomes.len();
        with_columns!(self, columns => columns.slots(cells).put(0, outcomes));
    }

    /// Takes outcomes, each to its place.
    pub fn place(&mut self, outcomes: &[(usize, Outcome)]) {
        fn place<C: ColumnType, F: ColumnNumber>(
            to: &mut Columns<F>,
            outcomes: &[(usize, Outcome)],
        ) {
            let values = C::values_mut(to);
            for (place, cell) in outcomes {
                values[*place] = C::of(cell).stored::<F>();
            }
        }
        for column in Column::ALL {
            with_column!(column, C => with_columns!(self, to => place::<C, _>(to, outcomes)));
        }
    }

    /// Takes the outcomes of a given number of cells from a place on, by all threads; `of` adds those of some cells, by their
    /// numbers among them, to a list. They stay in a fast cache until they are in their columns.
    pub fn fill(
        &mut self,
        first: usize,
        count: usize,
        of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync,
    ) {
        with_columns!(self, columns => columns.slots(first..first + count).fill(count, of));
    }

    /// Takes some cells of another block from a place on; numbers become as wide as those here.
    pub fn take(&mut self, first: usize, from: &Block, cells: Range<usize>) {
        let places = first..first + cells.len();
        with_columns!(self, to => with_columns!(from, from => to.slots(places).take(from, cells)));
    }

    /// Takes all cells of another block, each to its place.
    pub fn scatter(&mut self, places: &[usize], from: &Block) {
        // Places that follow one another are taken at once.
        let mut done = 0;
        for run in places.chunk_by(|one, next| *next == one + 1) {
            self.take(run[0], from, done..done + run.len());
            done += run.len();
        }
    }
}

impl<F: ColumnNumber> Slots<'_, F> {
    /// Puts outcomes in the slots from a place on.
    fn put(&mut self, first: usize, outcomes: &[Outcome]) {
        for (number, some) in outcomes.chunks(AT_ONCE).enumerate() {
            let from = first + number * AT_ONCE;
            for column in Column::ALL {
                with_column!(column, C => put::<C, F>(&mut C::slots(self)[from..], some));
            }
        }
    }

    /// Puts the outcomes that `of` tells, by all threads.
    fn fill(mut self, count: usize, of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync) {
        let cut = |from: usize| {
            let cells = from..(from + A_THREAD).min(count);
            (cells.clone(), self.cut(cells.len()))
        };
        let mut parts: Vec<(Range<usize>, Slots<F>)> =
            (0..count).step_by(A_THREAD).map(cut).collect();
        parallel::each_slice(&mut parts, 1, |_, parts| {
            let (cells, slots) = &mut parts[0];
            let mut outcomes = Vec::with_capacity(FILLED);
            for from in cells.clone().step_by(FILLED) {
                outcomes.clear();
                of(from..(from + FILLED).min(cells.end), &mut outcomes);
                slots.put(from - cells.start, &outcomes);
            }
        });
    }

    /// Takes some values of other columns.
    fn take<G: ColumnNumber>(&mut self, from: &Columns<G>, cells: Range<usize>) {
        for column in Column::ALL {
            with_column!(column, C => {
                take::<ValueOf<C>, F, G>(C::slots(self), &C::values(from)[cells.clone()]);
            });
        }
    }
}

/// Puts a column of outcomes in slots.
fn put<C: ColumnType, F: ColumnNumber>(slots: &mut [Stored<C::Value, F>], outcomes: &[Outcome]) {
    for (slot, cell) in slots.iter_mut().zip(outcomes) {
        *slot = C::of(cell).stored::<F>();
    }
}

/// Takes values of a column, as wide as the slots are.
fn take<V: CellValue, F: ColumnNumber, G: ColumnNumber>(
    slots: &mut [Stored<V, F>],
    from: &[Stored<V, G>],
) {
    for (slot, value) in slots.iter_mut().zip(from) {
        *slot = V::resized::<G, F>(*value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stepping::outcome::{Class, Status};

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
                placed.place(&[(place, outcome(cell))]);
                expected[place] = outcome(cell);
            }
            placed.place(&[(4, outcome(4)), (3, outcome(5))]);
            (expected[4], expected[3]) = (outcome(4), outcome(5));
            assert_eq!(placed, Block::of_outcomes(&expected, precision));
        }
    }

    /// Cells are taken to their places, and numbers become as wide as those there.
    #[test]
    fn cells_are_scattered() {
        let outcomes: Vec<Outcome> = (0..6).map(outcome).collect();
        let from = Block::of_outcomes(&outcomes, Precision::F64);
        for precision in [Precision::F32, Precision::F64] {
            let mut to = Block::pending(9, precision);
            to.scatter(&[8, 1, 2, 3, 0, 6], &from);
            let mut expected = vec![Outcome::PENDING; 9];
            for (cell, place) in [8, 1, 2, 3, 0, 6].into_iter().enumerate() {
                expected[place] = outcomes[cell];
            }
            assert_eq!(to, Block::of_outcomes(&expected, precision));
            assert_eq!(to.done(), [0..4, 6..7, 8..9]);
        }
    }
}
