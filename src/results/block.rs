//! The columns of a run of cells in memory: a vector each, numbers as wide as the sweep's.

use std::ops::Range;

pub use super::cell_value::PENDING;
use super::cell_value::{CellValue, Stored};
use super::column_set::ColumnSet;
use super::columns::{Column, ColumnType, Columns, ValueOf, with_column};
pub use super::element::ColumnValues;
use super::element::{ColumnNumber, Element};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Cells that go from outcomes to columns at once, or back: as many as a fast cache holds.
pub(super) const AT_ONCE: usize = 1 << 8;

/// The columns of cells that lie one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Block(pub(super) EitherColumns);

/// Columns of either number type, which a run chooses.
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

/// An expression for the columns of a block, whatever their number type.
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

/// Bytes of a cell's columns in memory.
pub fn bytes_a_cell(precision: Precision) -> usize {
    fn width<C: ColumnType>(precision: Precision) -> usize {
        match precision {
            Precision::F32 => size_of::<Stored<C::Value, f32>>(),
            Precision::F64 => size_of::<Stored<C::Value, f64>>(),
        }
    }
    let width = |column: Column| with_column!(column, C => width::<C>(precision));
    Column::ALL.into_iter().map(width).sum()
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

    /// Columns of which nothing is known.
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

/// Moves the values of a column to the end of those of other columns, as wide as these.
fn append<C: ColumnType, F: ColumnNumber, G: ColumnNumber>(
    to: &mut Columns<F>,
    from: &mut Columns<G>,
) {
    let values = std::mem::take(C::values_mut(from));
    C::values_mut(to).extend(values.into_iter().map(C::Value::resized::<G, F>));
}

/// Says of a column of outcomes that it is not known.
pub(super) fn leave_out<C: ColumnType>(outcomes: &mut [Outcome]) {
    for cell in outcomes {
        C::give(cell, C::Value::of::<f64>(C::Value::filler::<f64>()));
    }
}

/// Fills a column of outcomes.
pub(super) fn read<C: ColumnType, F: ColumnNumber>(
    values: &[Stored<C::Value, F>],
    outcomes: &mut [Outcome],
) {
    for (cell, value) in outcomes.iter_mut().zip(values) {
        C::give(cell, C::Value::of::<F>(*value));
    }
}

/// The runs of cells that have run, by the codes of their statuses.
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
    /// The columns of a given number of cells of which none has run.
    pub fn pending(count: usize, precision: Precision) -> Block {
        match precision {
            Precision::F32 => Columns::<f32>::pending(count).into(),
            Precision::F64 => Columns::<f64>::pending(count).into(),
        }
    }

    /// Blocks one after the other, numbers as wide as the first's. It holds a column twice at most: each goes from its
    /// block when it is taken.
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

    /// Number of cells.
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

    /// Some of its columns, in the table's order.
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

    /// Of some cells, those that have not run.
    pub fn pending_in(&self, cells: Range<usize>) -> usize {
        self.codes().1[cells].iter().filter(|code| **code == PENDING).count()
    }

    /// Fills some columns of the outcomes of cells from a place on.
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

    /// The outcomes of all cells; of those that have not run [`Outcome::PENDING`].
    pub fn to_outcomes(&self) -> Vec<Outcome> {
        let mut outcomes = vec![Outcome::PENDING; self.len()];
        self.read(0, &Column::ALL, &mut outcomes);
        outcomes
    }

    /// The runs of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        done(self.codes().1)
    }
}
