//! The values of a column in memory, and as bytes. Only here, and where bytes are described, has a column a number type.

use std::ops::Range;

use super::cell_value::{ColumnKind, PENDING};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Outcome, Status};

/// The number type of a column's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueType {
    /// Codes.
    U8,
    /// Numbers of events.
    U32,
    /// Numbers of a sweep in f32.
    F32,
    /// Numbers of a sweep in f64.
    F64,
}

impl ValueType {
    /// That of the columns of a kind, in a sweep of a precision.
    pub fn of(kind: ColumnKind, precision: Precision) -> ValueType {
        match (kind, precision) {
            (ColumnKind::Class | ColumnKind::Status, _) => ValueType::U8,
            (ColumnKind::Count, _) => ValueType::U32,
            (ColumnKind::Number | ColumnKind::Time, Precision::F32) => ValueType::F32,
            (ColumnKind::Number | ColumnKind::Time, Precision::F64) => ValueType::F64,
        }
    }

    /// Bytes of a value.
    pub fn size(self) -> usize {
        match self {
            ValueType::U8 => 1,
            ValueType::U32 | ValueType::F32 => 4,
            ValueType::F64 => 8,
        }
    }

    /// Its name in a Zarr document.
    pub fn in_zarr(self) -> &'static str {
        match self {
            ValueType::U8 => "uint8",
            ValueType::U32 => "uint32",
            ValueType::F32 => "float32",
            ValueType::F64 => "float64",
        }
    }

    /// Its name in numpy, of values whose lowest byte comes first.
    pub fn in_numpy(self) -> &'static str {
        match self {
            ValueType::U8 => "|u1",
            ValueType::U32 => "<u4",
            ValueType::F32 => "<f4",
            ValueType::F64 => "<f8",
        }
    }
}

/// The values of a column, as the library hands them out.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Places in [`Class::ALL`](crate::Class::ALL) or [`Status::ALL`](crate::Status::ALL).
    Codes(Vec<u8>),
    /// Numbers of events.
    Counts(Vec<u32>),
    /// Numbers of a sweep in f32.
    Singles(Vec<f32>),
    /// Numbers of a sweep in f64.
    Doubles(Vec<f64>),
}

/// Some values of a column, to be written to.
pub enum Slots<'a> {
    /// Codes.
    Codes(&'a mut [u8]),
    /// Numbers of events.
    Counts(&'a mut [u32]),
    /// Numbers of a sweep in f32.
    Singles(&'a mut [f32]),
    /// Numbers of a sweep in f64.
    Doubles(&'a mut [f64]),
}

/// The bytes of values, the lowest of each first.
pub(super) fn bytes_of<T: Copy, const N: usize>(values: &[T], bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| bytes(*value)).collect()
}

/// The first values that lie in bytes.
fn first_of<T, const N: usize>(bytes: &[u8], count: usize, of: fn([u8; N]) -> T) -> Vec<T> {
    let (values, _) = bytes.as_chunks();
    values.iter().take(count).map(|bytes| of(*bytes)).collect()
}

impl ColumnValues {
    /// A number as often as there are cells.
    pub(super) fn all(number: f64, of: ValueType, cells: usize) -> ColumnValues {
        match of {
            ValueType::U8 => ColumnValues::Codes(vec![number as u8; cells]),
            ValueType::U32 => ColumnValues::Counts(vec![number as u32; cells]),
            ValueType::F32 => ColumnValues::Singles(vec![number as f32; cells]),
            ValueType::F64 => ColumnValues::Doubles(vec![number; cells]),
        }
    }

    /// The first values that lie in bytes, so many at most.
    pub(super) fn of_bytes(bytes: &[u8], of: ValueType, cells: usize) -> ColumnValues {
        match of {
            ValueType::U8 => ColumnValues::Codes(first_of(bytes, cells, u8::from_le_bytes)),
            ValueType::U32 => ColumnValues::Counts(first_of(bytes, cells, u32::from_le_bytes)),
            ValueType::F32 => ColumnValues::Singles(first_of(bytes, cells, f32::from_le_bytes)),
            ValueType::F64 => ColumnValues::Doubles(first_of(bytes, cells, f64::from_le_bytes)),
        }
    }

    /// Their bytes, the lowest of each first.
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            ColumnValues::Codes(values) => values.clone(),
            ColumnValues::Counts(values) => bytes_of(values, u32::to_le_bytes),
            ColumnValues::Singles(values) => bytes_of(values, f32::to_le_bytes),
            ColumnValues::Doubles(values) => bytes_of(values, f64::to_le_bytes),
        }
    }

    /// Their type.
    pub fn value_type(&self) -> ValueType {
        match self {
            ColumnValues::Codes(_) => ValueType::U8,
            ColumnValues::Counts(_) => ValueType::U32,
            ColumnValues::Singles(_) => ValueType::F32,
            ColumnValues::Doubles(_) => ValueType::F64,
        }
    }

    /// True where there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of values.
    pub fn len(&self) -> usize {
        match self {
            ColumnValues::Codes(values) => values.len(),
            ColumnValues::Counts(values) => values.len(),
            ColumnValues::Singles(values) => values.len(),
            ColumnValues::Doubles(values) => values.len(),
        }
    }

    /// Those of a column of codes.
    pub(super) fn codes(&self) -> &[u8] {
        match self {
            ColumnValues::Codes(codes) => codes,
            _ => &[],
        }
    }

    /// True where each code of a column of a kind has a name, or is that of a cell that has not run.
    pub(super) fn have_names(&self, kind: ColumnKind) -> bool {
        let named = |code: u8| match kind {
            ColumnKind::Class => usize::from(code) < Class::ALL.len(),
            _ => usize::from(code) < Status::ALL.len() || code == PENDING,
        };
        self.codes().iter().all(|code| named(*code))
    }

    /// The ranges of cells that have run, of a column of statuses.
    pub(super) fn done(&self) -> Vec<Range<usize>> {
        let mut done: Vec<Range<usize>> = Vec::new();
        for (cell, _) in self.codes().iter().enumerate().filter(|(_, code)| **code != PENDING) {
            match done.last_mut() {
                Some(last) if last.end == cell => last.end = cell + 1,
                _ => done.push(cell..cell + 1),
            }
        }
        done
    }

    /// Those of some cells, to be written to.
    pub(super) fn slots(&mut self, cells: Range<usize>) -> Slots<'_> {
        match self {
            ColumnValues::Codes(values) => Slots::Codes(&mut values[cells]),
            ColumnValues::Counts(values) => Slots::Counts(&mut values[cells]),
            ColumnValues::Singles(values) => Slots::Singles(&mut values[cells]),
            ColumnValues::Doubles(values) => Slots::Doubles(&mut values[cells]),
        }
    }

    /// Sets a number of each outcome from the values from a place on.
    #[inline(always)]
    pub(super) fn give(
        &self,
        first: usize,
        outcomes: &mut [Outcome],
        set: impl Fn(&mut Outcome, f64),
    ) {
        fn each<T: Copy + Into<f64>>(
            values: &[T],
            outcomes: &mut [Outcome],
            set: impl Fn(&mut Outcome, f64),
        ) {
            for (cell, value) in outcomes.iter_mut().zip(values) {
                set(cell, (*value).into());
            }
        }
        match self {
            ColumnValues::Codes(values) => each(&values[first..], outcomes, set),
            ColumnValues::Counts(values) => each(&values[first..], outcomes, set),
            ColumnValues::Singles(values) => each(&values[first..], outcomes, set),
            ColumnValues::Doubles(values) => each(&values[first..], outcomes, set),
        }
    }
}

/// Splits `count` values off the front.
fn cut<'a, T>(values: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (front, rest) = std::mem::take(values).split_at_mut(count);
    *values = rest;
    front
}

impl<'a> Slots<'a> {
    /// Splits `count` cells off the front.
    pub(super) fn cut(&mut self, count: usize) -> Slots<'a> {
        match self {
            Slots::Codes(values) => Slots::Codes(cut(values, count)),
            Slots::Counts(values) => Slots::Counts(cut(values, count)),
            Slots::Singles(values) => Slots::Singles(cut(values, count)),
            Slots::Doubles(values) => Slots::Doubles(cut(values, count)),
        }
    }

    /// Puts a number of each outcome at its place.
    #[inline(always)]
    pub(super) fn put(
        &mut self,
        places: &[usize],
        outcomes: &[Outcome],
        number: impl Fn(&Outcome) -> f64,
    ) {
        fn each<T>(
            values: &mut [T],
            places: &[usize],
            outcomes: &[Outcome],
            value: impl Fn(&Outcome) -> T,
        ) {
            for (place, cell) in places.iter().zip(outcomes) {
                values[*place] = value(cell);
            }
        }
        match self {
            Slots::Codes(values) => each(values, places, outcomes, |cell| number(cell) as u8),
            Slots::Counts(values) => each(values, places, outcomes, |cell| number(cell) as u32),
            Slots::Singles(values) => each(values, places, outcomes, |cell| number(cell) as f32),
            Slots::Doubles(values) => each(values, places, outcomes, number),
        }
    }

    /// Copies values of the same column of another block; numbers become as wide as those here.
    pub(super) fn copy(self, from: &ColumnValues, cells: Range<usize>) {
        match (self, from) {
            (Slots::Codes(to), ColumnValues::Codes(from)) => to.copy_from_slice(&from[cells]),
            (Slots::Counts(to), ColumnValues::Counts(from)) => to.copy_from_slice(&from[cells]),
            (Slots::Singles(to), ColumnValues::Singles(from)) => to.copy_from_slice(&from[cells]),
            (Slots::Doubles(to), ColumnValues::Doubles(from)) => to.copy_from_slice(&from[cells]),
            (Slots::Singles(to), ColumnValues::Doubles(from)) => {
                to.iter_mut().zip(&from[cells]).for_each(|(to, from)| *to = *from as f32);
            }
            (Slots::Doubles(to), ColumnValues::Singles(from)) => {
                to.iter_mut().zip(&from[cells]).for_each(|(to, from)| *to = f64::from(*from));
            }
            // A column has codes or counts in every block.
            _ => {}
        }
    }
}
