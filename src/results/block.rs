//! The columns of consecutive cells in memory: one vector for each column, with numbers of the type of the sweep.

use std::ops::Range;

pub use super::cell_value::PENDING;
use super::cell_value::{CellValue, Stored};
use super::column_set::ColumnSet;
use super::columns::{Column, ColumnType, Columns, ValueOf, with_column};
pub use super::element::ColumnValues;
use super::element::{ColumnNumber, Element};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Number of cells that are converted at once from outcomes to columns, or back: as many as a fast cache holds.
pub(super) const AT_ONCE: usize = 1 << 8;

/// The columns of consecutive cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Block(pub(super) EitherColumns);

/// Columns of either number type. The sweep chooses the type.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum EitherColumns {
    Singles(Columns<f32>),
    Doubles(Columns<f64>),
}

impl From<Columns<f32>> for Block {
    fn from(columns: Columns<f32>) -> Block {
        Block(EitherColumns::Singles(columns))
    }
}

impl From<Columns<f64>> for Block {
    fn from(columns: Columns<f64>) -> Block {
        Block(EitherColumns::Doubles(columns))
    }
}

/// Evaluates an expression for the columns of a block, whatever their number type.
macro_rules! with_columns {
    ($block:expr, $columns:pat => $body:expr) => {
        match $block {
            $crate::results::block::Block($crate::results::block::EitherColumns::Singles(
                $columns,
            )) => $body,
            $crate::results::block::Block($crate::results::block::EitherColumns::Doubles(
                $columns,
            )) => $body,
        }
    };
}
pub(super) use with_columns;

/// Number of bytes that a value of a column takes.
pub(super) fn width(column: Column, precision: Precision) -> usize {
    with_column!(column, C => match precision {
        Precision::F32 => size_of::<Stored<ValueOf<C>, f32>>(),
        Precision::F64 => size_of::<Stored<ValueOf<C>, f64>>(),
    })
}

/// Number of bytes that the columns of one cell take in memory.
pub fn bytes_a_cell(precision: Precision) -> usize {
    Column::ALL.into_iter().map(|column| width(column, precision)).sum()
}

impl<F: ColumnNumber> Columns<F> {
    fn pending(count: usize) -> Columns<F> {
        let mut columns = Columns::default();
        for column in Column::ALL {
            with_column!(column, C => {
                *C::values_mut(&mut columns) = vec![ValueOf::<C>::pending::<F>(); count];
            });
        }
        columns
    }

    /// Columns whose values are all unknown.
    pub(super) fn absent(count: usize) -> Columns<F> {
        let mut columns = Columns::default();
        for column in Column::ALL {
            with_column!(column, C => {
                *C::values_mut(&mut columns) = vec![ValueOf::<C>::filler::<F>(); count];
            });
        }
        columns
    }
}

/// Appends the values of a column to those of another one, converted to its number type.
fn append<C: ColumnType, F: ColumnNumber, G: ColumnNumber>(
    to: &mut Columns<F>,
    from: &mut Columns<G>,
) {
    let values = std::mem::take(C::values_mut(from));
    C::values_mut(to).extend(values.into_iter().map(C::Value::resized::<G, F>));
}

/// Marks the field of a column in outcomes as not known.
pub(super) fn leave_out<C: ColumnType>(outcomes: &mut [Outcome]) {
    for cell in outcomes {
        C::give(cell, C::Value::of::<f64>(C::Value::filler::<f64>()));
    }
}

/// Sets the field of a column in outcomes, from stored values.
pub(super) fn read<C: ColumnType, F: ColumnNumber>(
    values: &[Stored<C::Value, F>],
    outcomes: &mut [Outcome],
) {
    for (cell, value) in outcomes.iter_mut().zip(values) {
        C::give(cell, C::Value::of::<F>(*value));
    }
}

/// The ranges of cells that have run, by the codes of their statuses.
pub(super) fn done(codes: &[u8]) -> Vec<Range<usize>> {
    let mut done: Vec<Range<usize>> = Vec::new();
    for (cell, _) in codes.iter().enumerate().filter(|(_, code)| **code != PENDING) {
        match done.last_mut() {
            Some(last) if last.end == cell => last.end = cell + 1,
            _ => done.push(cell..cell + 1),
        }
    }
    done
}

impl Block {
    /// The columns of a given number of cells, none of which has run.
    pub fn pending(count: usize, precision: Precision) -> Block {
        match precision {
            Precision::F32 => Columns::<f32>::pending(count).into(),
            Precision::F64 => Columns::<f64>::pending(count).into(),
        }
    }

    /// Joins blocks, with numbers of the type of the first one. At most one column is held twice at a time, because each column
    /// leaves its block when it is taken.
    pub fn joined(mut blocks: Vec<Block>) -> Block {
        fn join<F: ColumnNumber>(whole: &mut Columns<F>, blocks: &mut [Block], count: usize) {
            for column in Column::ALL {
                with_column!(column, C => {
                    let values = C::values_mut(whole);
                    values.reserve_exact(count - values.len());
                    for block in &mut *blocks {
                        with_columns!(block, from => append::<C, F, _>(whole, from));
                    }
                });
            }
        }
        let count = blocks.iter().map(Block::len).sum();
        if blocks.is_empty() {
            return Block::pending(0, Precision::F32);
        }
        let mut whole = blocks.remove(0);
        with_columns!(&mut whole, columns => join(columns, &mut blocks, count));
        whole
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.codes().0.len()
    }

    /// True where there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The codes of classes and statuses.
    fn codes(&self) -> (&[u8], &[u8]) {
        with_columns!(self, columns => (&columns.class, &columns.status))
    }

    /// The class of a cell; unresolved where it has not run.
    pub fn class(&self, cell: usize) -> Class {
        let (classes, statuses) = self.codes();
        match statuses[cell] {
            PENDING => Class::Unresolved,
            _ => Class::ALL[usize::from(classes[cell])],
        }
    }

    /// Changes the classes and statuses of cells that have run; `change` is handed a cell's number and both.
    pub fn recode(&mut self, change: impl Fn(usize, Class, Status) -> (Class, Status)) {
        let (classes, statuses) =
            with_columns!(self, columns => (&mut columns.class, &mut columns.status));
        let ran = classes.iter_mut().zip(statuses).enumerate();
        for (cell, (class, status)) in ran.filter(|(_, (_, status))| **status != PENDING) {
            let before = (Class::ALL[usize::from(*class)], Status::ALL[usize::from(*status)]);
            let changed = change(cell, before.0, before.1);
            (*class, *status) = (changed.0 as u8, changed.1 as u8);
        }
    }

    /// The number type of its columns.
    pub fn precision(&self) -> Precision {
        match self.0 {
            EitherColumns::Singles(_) => Precision::F32,
            EitherColumns::Doubles(_) => Precision::F64,
        }
    }

    /// Some of the columns, in the order of the table.
    pub fn into_columns(self, asked: ColumnSet) -> Vec<(Column, ColumnValues)> {
        with_columns!(self, mut columns => {
            let mut handed_out = |column| {
                with_column!(column, C => {
                    Element::handed_out(std::mem::take(C::values_mut(&mut columns)))
                })
            };
            asked.columns().map(|column| (column, handed_out(column))).collect()
        })
    }

    /// Those of the given cells that have not run.
    pub fn pending_in(&self, cells: Range<usize>) -> usize {
        self.codes().1[cells].iter().filter(|code| **code == PENDING).count()
    }

    /// Sets the fields of some columns in outcomes; the first outcome is that of the cell `first` of the block.
    pub fn read(&self, first: usize, columns: &[Column], outcomes: &mut [Outcome]) {
        fn of<F: ColumnNumber>(
            all: &Columns<F>,
            first: usize,
            columns: &[Column],
            outcomes: &mut [Outcome],
        ) {
            for (number, some) in outcomes.chunks_mut(AT_ONCE).enumerate() {
                let from = first + number * AT_ONCE;
                for column in columns {
                    with_column!(column, C => read::<C, F>(&C::values(all)[from..], some));
                }
            }
        }
        with_columns!(self, all => of(all, first, columns, outcomes));
    }

    /// The outcomes of all cells; [`Outcome::PENDING`] for those that have not run.
    pub fn to_outcomes(&self) -> Vec<Outcome> {
        let mut outcomes = vec![Outcome::PENDING; self.len()];
        self.read(0, &Column::ALL, &mut outcomes);
        outcomes
    }

    /// The ranges of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        done(self.codes().1)
    }
}
