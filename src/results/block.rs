//! The columns of a run of cells in memory: a vector each, numbers as wide as the sweep's.

use std::ops::Range;

use super::columns::{Column, Holds, TABLE};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Outcome, Status};

/// The status of a cell that has not run, in memory; no status has this code.
pub const PENDING: u8 = u8::MAX;

/// Cells that go from outcomes to columns at once, or back: as many as a fast cache holds.
pub(super) const AT_ONCE: usize = 1 << 8;

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Places in [`Class::ALL`] or [`Status::ALL`].
    Codes(Vec<u8>),
    /// Numbers of events.
    Counts(Vec<u32>),
    /// Numbers of a sweep in f32.
    Singles(Vec<f32>),
    /// Numbers of a sweep in f64.
    Doubles(Vec<f64>),
}

/// The columns of cells that lie one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    pub(super) values: Vec<Values>,
    count: usize,
}

/// Bytes of a cell's columns in memory.
pub fn bytes_a_cell(precision: Precision) -> usize {
    let number = match precision {
        Precision::F32 => 4,
        Precision::F64 => 8,
    };
    let width = |holds: Holds| match holds {
        Holds::Class | Holds::Status => 1,
        Holds::Count { .. } => 4,
        Holds::Number { .. } | Holds::Time { .. } => number,
    };
    TABLE.iter().map(|entry| width(entry.holds)).sum()
}

impl Block {
    /// The columns of so many cells of which none has run.
    pub fn pending(count: usize, precision: Precision) -> Block {
        let values = TABLE.iter().map(|entry| match (entry.holds, precision) {
            (Holds::Class, _) => Values::Codes(vec![Class::Unresolved as u8; count]),
            (Holds::Status, _) => Values::Codes(vec![PENDING; count]),
            (Holds::Count { .. }, _) => Values::Counts(vec![0; count]),
            (_, Precision::F32) => Values::Singles(vec![0.0; count]),
            (_, Precision::F64) => Values::Doubles(vec![0.0; count]),
        });
        Block { values: values.collect(), count }
    }

    /// The same of columns in the table's order; none where they are not of one length, or a code is of
    /// nothing.
    pub fn of(values: Vec<Values>) -> Option<Block> {
        let count = values.first()?.len();
        let block = Block { values, count };
        let whole = block.values.len() == TABLE.len()
            && TABLE
                .iter()
                .zip(&block.values)
                .all(|(entry, values)| values.len() == count && values.suit(entry.holds));
        whole.then_some(block)
    }

    /// Blocks one after the other. It holds a column twice at most: each goes from its block when it is taken.
    pub fn joined(mut blocks: Vec<Block>) -> Block {
        let count = blocks.iter().map(Block::len).sum();
        let column = |place: usize| {
            let taken = |block: &mut Block| {
                std::mem::replace(&mut block.values[place], Values::Codes(Vec::new()))
            };
            let mut parts = blocks.iter_mut().map(taken);
            let mut whole = parts.next().unwrap_or(Values::Codes(Vec::new()));
            whole.reserve(count - whole.len());
            parts.for_each(|part| whole.append(part));
            whole
        };
        Block { values: (0..TABLE.len()).map(column).collect(), count }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.count
    }

    /// True where there is no cell.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The values of a column.
    pub fn column(&self, column: Column) -> &Values {
        &self.values[column as usize]
    }

    /// The class of a cell, and how its integration ended; none of one that has not run.
    fn class_and_status(&self, cell: usize) -> Option<(Class, Status)> {
        match (self.column(Column::Outcome), self.column(Column::Status)) {
            (Values::Codes(classes), Values::Codes(statuses)) if statuses[cell] != PENDING => {
                let class = Class::ALL[usize::from(classes[cell])];
                Some((class, Status::ALL[usize::from(statuses[cell])]))
            }
            _ => None,
        }
    }

    /// The class of a cell; unresolved where it has not run.
    pub fn class(&self, cell: usize) -> Class {
        self.class_and_status(cell).map_or(Class::Unresolved, |(class, _)| class)
    }

    /// Changes the classes and statuses of cells that have run; `change` is handed a cell's number and both.
    pub fn recode(&mut self, change: impl Fn(usize, Class, Status) -> (Class, Status)) {
        for cell in 0..self.count {
            let Some((class, status)) = self.class_and_status(cell) else { continue };
            let changed = change(cell, class, status);
            if let Values::Codes(classes) = &mut self.values[Column::Outcome as usize] {
                classes[cell] = changed.0 as u8;
            }
            if let Values::Codes(statuses) = &mut self.values[Column::Status as usize] {
                statuses[cell] = changed.1 as u8;
            }
        }
    }

    /// The number type of its columns.
    pub fn precision(&self) -> Precision {
        match self.column(Column::Zeta) {
            Values::Doubles(_) => Precision::F64,
            _ => Precision::F32,
        }
    }

    /// Its columns, in the table's order.
    pub fn into_columns(self) -> Vec<Values> {
        self.values
    }

    /// Of some cells, those that have not run.
    pub fn pending_in(&self, cells: Range<usize>) -> usize {
        match self.column(Column::Status) {
            Values::Codes(codes) => codes[cells].iter().filter(|code| **code == PENDING).count(),
            _ => 0,
        }
    }

    /// Fills some columns of the outcomes of cells from a place on.
    pub fn read(&self, first: usize, columns: &[Column], outcomes: &mut [Outcome]) {
        for (number, some) in outcomes.chunks_mut(AT_ONCE).enumerate() {
            for column in columns {
                let values = &self.values[*column as usize];
                values.read(column.entry().holds, first + number * AT_ONCE, some);
            }
        }
    }

    /// The outcomes of all cells; of those that have not run [`Outcome::PENDING`].
    pub fn to_outcomes(&self) -> Vec<Outcome> {
        let mut outcomes = vec![Outcome::PENDING; self.count];
        self.read(0, &Column::ALL, &mut outcomes);
        outcomes
    }

    /// The runs of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        self.column(Column::Status).done().unwrap_or_default()
    }
}

/// The runs of cells that have run, by the codes of their statuses.
fn done(codes: &[u8]) -> Vec<Range<usize>> {
    let mut done: Vec<Range<usize>> = Vec::new();
    for (cell, _) in codes.iter().enumerate().filter(|(_, code)| **code != PENDING) {
        match done.last_mut() {
            Some(last) if last.end == cell => last.end = cell + 1,
            _ => done.push(cell..cell + 1),
        }
    }
    done
}

impl Values {
    /// The runs of cells that have run, by the codes of their statuses; none of other values.
    pub(super) fn done(&self) -> Option<Vec<Range<usize>>> {
        match self {
            Values::Codes(codes) => Some(done(codes)),
            _ => None,
        }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        match self {
            Values::Codes(values) => values.len(),
            Values::Counts(values) => values.len(),
            Values::Singles(values) => values.len(),
            Values::Doubles(values) => values.len(),
        }
    }

    /// True where there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn reserve(&mut self, more: usize) {
        match self {
            Values::Codes(values) => values.reserve_exact(more),
            Values::Counts(values) => values.reserve_exact(more),
            Values::Singles(values) => values.reserve_exact(more),
            Values::Doubles(values) => values.reserve_exact(more),
        }
    }

    fn append(&mut self, other: Values) {
        match (self, other) {
            (Values::Codes(values), Values::Codes(mut other)) => values.append(&mut other),
            (Values::Counts(values), Values::Counts(mut other)) => values.append(&mut other),
            (Values::Singles(values), Values::Singles(mut other)) => values.append(&mut other),
            (Values::Doubles(values), Values::Doubles(mut other)) => values.append(&mut other),
            // The blocks of a map are of one table and of one precision.
            _ => {}
        }
    }

    /// True of values that a column can hold.
    pub(super) fn suit(&self, holds: Holds) -> bool {
        match (holds, self) {
            (Holds::Class, Values::Codes(codes)) => {
                codes.iter().all(|code| usize::from(*code) < Class::ALL.len())
            }
            (Holds::Status, Values::Codes(codes)) => {
                codes.iter().all(|code| usize::from(*code) < Status::ALL.len() || *code == PENDING)
            }
            (Holds::Count { .. }, Values::Counts(_)) => true,
            (
                Holds::Number { .. } | Holds::Time { .. },
                Values::Singles(_) | Values::Doubles(_),
            ) => true,
            _ => false,
        }
    }

    /// Fills a column of the outcomes of cells from a place on.
    pub(super) fn read(&self, holds: Holds, first: usize, outcomes: &mut [Outcome]) {
        fn each<T: Copy>(values: &[T], outcomes: &mut [Outcome], set: impl Fn(&mut Outcome, T)) {
            for (cell, value) in outcomes.iter_mut().zip(values) {
                set(cell, *value);
            }
        }
        let time = |value: f64| (!value.is_nan()).then_some(value);
        match (holds, self) {
            (Holds::Class, Values::Codes(all)) => each(&all[first..], outcomes, |cell, code| {
                cell.class = Class::ALL[usize::from(code)];
            }),
            (Holds::Status, Values::Codes(all)) => each(&all[first..], outcomes, |cell, code| {
                cell.status = match code {
                    PENDING => Outcome::PENDING.status,
                    code => Status::ALL[usize::from(code)],
                };
            }),
            (Holds::Count { place, .. }, Values::Counts(all)) => {
                each(&all[first..], outcomes, |cell, value| *place(cell) = value);
            }
            (Holds::Number { place, .. }, Values::Singles(all)) => {
                each(&all[first..], outcomes, |cell, value| *place(cell) = f64::from(value));
            }
            (Holds::Number { place, .. }, Values::Doubles(all)) => {
                each(&all[first..], outcomes, |cell, value| *place(cell) = value);
            }
            (Holds::Time { place, .. }, Values::Singles(all)) => {
                each(&all[first..], outcomes, |cell, value| *place(cell) = time(f64::from(value)));
            }
            (Holds::Time { place, .. }, Values::Doubles(all)) => {
                each(&all[first..], outcomes, |cell, value| *place(cell) = time(value));
            }
            // A block is made of values that suit their columns.
            _ => {}
        }
    }
}
