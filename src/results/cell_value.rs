//! The values of a cell in a column, and how a column stores them. The type of the field of an outcome decides both, so that no
//! column can be filled with the numbers of another.

use super::element::{ColumnNumber, Element};
use crate::stepping::outcome::{Class, Outcome, Status};

/// The status of a cell that has not run, in memory and on disk; no status has this code.
pub const PENDING: u8 = u8::MAX;

/// The names of statuses in files, by their codes.
pub const STATUS_NAMES: [&str; 6] =
    ["ok", "event_limit", "diverged", "step_limit", "vertical_locked", "undecided"];

/// The code of a class.
pub fn class_code(class: Class) -> u8 {
    class as u8
}

/// The code of a status. A cell whose end was proved (the second status) counts as one that ran to its end (the first).
pub fn status_code(status: Status) -> u8 {
    (status as u8).saturating_sub(1)
}

/// The kinds of columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// A class: written by its name, as a number by its place in [`Class::ALL`].
    Class,
    /// A status: written by its name, as a number by its place in [`STATUS_NAMES`].
    Status,
    /// A number of events.
    Count,
    /// A number.
    Number,
    /// A time that not every cell has.
    Time,
}

/// The value of a cell in a column, as it is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// A code and its name.
    Code(u8, &'static str),
    /// A number of events.
    Count(u32),
    /// A number.
    Number(f64),
    /// A time, if the cell has it.
    Time(Option<f64>),
}

impl Shown {
    /// The value as a number: the code or the count; NaN for a time that the cell does not have.
    pub fn number(self) -> f64 {
        match self {
            Shown::Code(code, _) => f64::from(code),
            Shown::Count(count) => f64::from(count),
            Shown::Number(number) => number,
            Shown::Time(time) => time.unwrap_or(f64::NAN),
        }
    }
}

/// The type in which a column stores a value, in a sweep of a number type.
pub type Stored<V, F> = <V as CellValue>::Stored<F>;

/// The value of a cell in a column: a field of its [`Outcome`].
pub trait CellValue: Copy {
    /// The type in which the column stores it.
    type Stored<F: ColumnNumber>: Element;
    /// The kind of its columns.
    const KIND: ColumnKind;
    /// True where a file says beside the value that the cell ended early.
    const HAS_PROVED: bool = false;

    /// The stored value of a cell that has not run.
    fn pending<F: ColumnNumber>() -> Stored<Self, F> {
        Stored::<Self, F>::default()
    }

    /// The stored value that fills up a file, and that stands for an unknown value.
    fn filler<F: ColumnNumber>() -> Stored<Self, F> {
        Self::pending::<F>()
    }

    /// The stored form of the value.
    fn stored<F: ColumnNumber>(self) -> Stored<Self, F>;

    /// The value of a stored form.
    fn of<F: ColumnNumber>(stored: Stored<Self, F>) -> Self;

    /// The stored form in a column of another number type.
    fn resized<F: ColumnNumber, G: ColumnNumber>(stored: Stored<Self, F>) -> Stored<Self, G> {
        Self::of::<F>(stored).stored::<G>()
    }

    /// The form in a file.
    fn to_file<F: ColumnNumber>(stored: Stored<Self, F>) -> Stored<Self, F> {
        stored
    }

    /// Converts the form of a file to the stored form, given a 1 for each cell that ended early. False where a code in the file has
    /// no meaning.
    fn of_file<F: ColumnNumber>(_filed: &mut [Stored<Self, F>], _proved: &[u8]) -> bool {
        true
    }

    /// The value to be shown.
    fn shown(self) -> Shown;
}

impl CellValue for Class {
    type Stored<F: ColumnNumber> = u8;
    const KIND: ColumnKind = ColumnKind::Class;

    fn pending<F: ColumnNumber>() -> u8 {
        Class::Unresolved as u8
    }

    fn stored<F: ColumnNumber>(self) -> u8 {
        self as u8
    }

    fn of<F: ColumnNumber>(code: u8) -> Class {
        Class::ALL[usize::from(code)]
    }

    fn resized<F: ColumnNumber, G: ColumnNumber>(code: u8) -> u8 {
        code
    }

    fn of_file<F: ColumnNumber>(codes: &mut [u8], _: &[u8]) -> bool {
        codes.iter().all(|code| usize::from(*code) < Class::ALL.len())
    }

    fn shown(self) -> Shown {
        Shown::Code(class_code(self), self.name())
    }
}

/// A status is stored as its place in [`Status::ALL`], and written to files as its place in [`STATUS_NAMES`].
impl CellValue for Status {
    type Stored<F: ColumnNumber> = u8;
    const KIND: ColumnKind = ColumnKind::Status;
    const HAS_PROVED: bool = true;

    fn pending<F: ColumnNumber>() -> u8 {
        PENDING
    }

    fn stored<F: ColumnNumber>(self) -> u8 {
        self as u8
    }

    fn of<F: ColumnNumber>(code: u8) -> Status {
        match code {
            PENDING => Outcome::PENDING.status,
            code => Status::ALL[usize::from(code)],
        }
    }

    fn resized<F: ColumnNumber, G: ColumnNumber>(code: u8) -> u8 {
        code
    }

    fn to_file<F: ColumnNumber>(code: u8) -> u8 {
        Status::ALL.get(usize::from(code)).map_or(PENDING, |status| status_code(*status))
    }

    fn of_file<F: ColumnNumber>(codes: &mut [u8], proved: &[u8]) -> bool {
        let named = |code| Status::ALL.into_iter().find(|status| status_code(*status) == code);
        codes.iter_mut().zip(proved).all(|(code, proved)| {
            let status = match (*code, *proved) {
                (PENDING, _) => return true,
                (0, 1) => Some(Status::Proved),
                (code, _) => named(code),
            };
            status.is_some_and(|status| {
                *code = status as u8;
                true
            })
        })
    }

    fn shown(self) -> Shown {
        Shown::Code(status_code(self), self.name())
    }
}

impl CellValue for u32 {
    type Stored<F: ColumnNumber> = u32;
    const KIND: ColumnKind = ColumnKind::Count;

    fn stored<F: ColumnNumber>(self) -> u32 {
        self
    }

    fn of<F: ColumnNumber>(count: u32) -> u32 {
        count
    }

    fn shown(self) -> Shown {
        Shown::Count(self)
    }
}

impl CellValue for f64 {
    type Stored<F: ColumnNumber> = F;
    const KIND: ColumnKind = ColumnKind::Number;

    fn filler<F: ColumnNumber>() -> F {
        F::of(f64::NAN)
    }

    fn stored<F: ColumnNumber>(self) -> F {
        F::of(self)
    }

    fn of<F: ColumnNumber>(number: F) -> f64 {
        number.to_f64()
    }

    fn shown(self) -> Shown {
        Shown::Number(self)
    }
}

/// A missing time is stored as NaN.
impl CellValue for Option<f64> {
    type Stored<F: ColumnNumber> = F;
    const KIND: ColumnKind = ColumnKind::Time;

    fn filler<F: ColumnNumber>() -> F {
        F::of(f64::NAN)
    }

    fn stored<F: ColumnNumber>(self) -> F {
        F::of(self.unwrap_or(f64::NAN))
    }

    fn of<F: ColumnNumber>(time: F) -> Option<f64> {
        Some(time.to_f64()).filter(|time| !time.is_nan())
    }

    fn shown(self) -> Shown {
        Shown::Time(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_and_status_has_a_code() {
        for (index, class) in Class::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(class_code(class)), index);
        }
        for status in Status::ALL {
            assert_eq!(STATUS_NAMES[usize::from(status_code(status))], status.name());
        }
    }
}
