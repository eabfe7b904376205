//! How the columns of a block are filled: with outcomes, by one thread or by all, and with the cells of another
//! block.

use std::ops::Range;

use rayon::prelude::*;

use super::block::{AT_ONCE, Block, Values};
use super::columns::{Holds, TABLE, each};
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;

/// Cells that a thread fills at once: some 100 kB of columns, which no other thread writes to.
const A_THREAD: usize = 1 << 11;

/// Cells that are made before they go to their columns.
const FILLED: usize = 1 << 6;

/// Some values of a column, to be written.
enum Slots<'a> {
    Codes(&'a mut [u8]),
    Counts(&'a mut [u32]),
    Singles(&'a mut [f32]),
    Doubles(&'a mut [f64]),
}

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
        put(&mut self.slots(first..first + outcomes.len()), outcomes);
    }

    /// Takes the outcomes of so many cells from a place on, by all threads; `of` adds those of some cells, by their
    /// numbers among them, to a list. They stay in a fast cache until they are in their columns.
    pub fn fill(
        &mut self,
        first: usize,
        count: usize,
        of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync,
    ) {
        let mut rest = self.slots(first..first + count);
        let cut = |from: usize| {
            let cells = from..(from + A_THREAD).min(count);
            (cells.clone(), rest.iter_mut().map(|slots| slots.cut(cells.len())).collect())
        };
        let parts: Vec<(Range<usize>, Vec<Slots>)> =
            (0..count).step_by(A_THREAD).map(cut).collect();
        parts.into_par_iter().for_each(|(cells, mut slots)| {
            let mut outcomes = Vec::with_capacity(FILLED);
            for from in cells.clone().step_by(FILLED) {
                outcomes.clear();
                of(from..(from + FILLED).min(cells.end), &mut outcomes);
                let mut some: Vec<Slots> =
                    slots.iter_mut().map(|slots| slots.cut(outcomes.len())).collect();
                put(&mut some, &outcomes);
            }
        });
    }

    /// Takes some cells of another block from a place on.
    pub fn take(&mut self, first: usize, from: &Block, cells: Range<usize>) {
        let places = first..first + cells.len();
        for (slots, from) in self.slots(places).into_iter().zip(&from.values) {
            slots.take(from, cells.clone());
        }
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

    fn slots(&mut self, cells: Range<usize>) -> Vec<Slots<'_>> {
        self.values.iter_mut().map(|values| values.slots(cells.clone())).collect()
    }
}

/// Puts outcomes in the first slots of each column.
fn put(columns: &mut [Slots], outcomes: &[Outcome]) {
    for (number, some) in outcomes.chunks(AT_ONCE).enumerate() {
        for (entry, slots) in TABLE.iter().zip(columns.iter_mut()) {
            slots.put(entry.holds, number * AT_ONCE, some);
        }
    }
}

impl Values {
    fn slots(&mut self, cells: Range<usize>) -> Slots<'_> {
        match self {
            Values::Codes(values) => Slots::Codes(&mut values[cells]),
            Values::Counts(values) => Slots::Counts(&mut values[cells]),
            Values::Singles(values) => Slots::Singles(&mut values[cells]),
            Values::Doubles(values) => Slots::Doubles(&mut values[cells]),
        }
    }
}

impl<'a> Slots<'a> {
    /// Takes so many from the front.
    fn cut(&mut self, count: usize) -> Slots<'a> {
        fn cut<'a, T>(slots: &mut &'a mut [T], count: usize) -> &'a mut [T] {
            let (front, rest) = std::mem::take(slots).split_at_mut(count);
            *slots = rest;
            front
        }
        match self {
            Slots::Codes(slots) => Slots::Codes(cut(slots, count)),
            Slots::Counts(slots) => Slots::Counts(cut(slots, count)),
            Slots::Singles(slots) => Slots::Singles(cut(slots, count)),
            Slots::Doubles(slots) => Slots::Doubles(cut(slots, count)),
        }
    }

    /// Puts a column of outcomes from a place on.
    fn put(&mut self, holds: Holds, first: usize, outcomes: &[Outcome]) {
        match (holds, self) {
            (Holds::Class, Slots::Codes(all)) => {
                each(outcomes, &mut all[first..], |cell| cell.class as u8);
            }
            (Holds::Status, Slots::Codes(all)) => {
                each(outcomes, &mut all[first..], |cell| cell.status as u8);
            }
            (Holds::Count { counts, .. }, Slots::Counts(all)) => {
                counts(outcomes, &mut all[first..]);
            }
            (Holds::Number { singles, .. } | Holds::Time { singles, .. }, Slots::Singles(all)) => {
                singles(outcomes, &mut all[first..]);
            }
            (Holds::Number { doubles, .. } | Holds::Time { doubles, .. }, Slots::Doubles(all)) => {
                doubles(outcomes, &mut all[first..]);
            }
            // A block is made of values that suit their columns.
            _ => {}
        }
    }

    /// Takes some values of the same column; numbers become as wide as these.
    fn take(self, from: &Values, cells: Range<usize>) {
        match (self, from) {
            (Slots::Codes(slots), Values::Codes(from)) => slots.copy_from_slice(&from[cells]),
            (Slots::Counts(slots), Values::Counts(from)) => slots.copy_from_slice(&from[cells]),
            (Slots::Singles(slots), Values::Singles(from)) => slots.copy_from_slice(&from[cells]),
            (Slots::Doubles(slots), Values::Doubles(from)) => slots.copy_from_slice(&from[cells]),
            (Slots::Singles(slots), Values::Doubles(from)) => {
                slots.iter_mut().zip(&from[cells]).for_each(|(slot, value)| *slot = *value as f32);
            }
            (Slots::Doubles(slots), Values::Singles(from)) => {
                let wider = slots.iter_mut().zip(&from[cells]);
                wider.for_each(|(slot, value)| *slot = f64::from(*value));
            }
            // Blocks are of one table.
            _ => {}
        }
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
