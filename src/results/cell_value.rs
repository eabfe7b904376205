//! The value of a cell in a column as a number, and as it is shown.

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

impl ColumnKind {
    /// The number in a column of this kind of a cell that has not run.
    pub(super) fn pending(self) -> f64 {
        match self {
            ColumnKind::Class => Class::Unresolved.number(),
            ColumnKind::Status => f64::from(PENDING),
            ColumnKind::Count | ColumnKind::Number | ColumnKind::Time => 0.0,
        }
    }

    /// The number that fills up a file, and that stands for an unknown value.
    pub(super) fn filler(self) -> f64 {
        match self {
            ColumnKind::Number | ColumnKind::Time => f64::NAN,
            kind => kind.pending(),
        }
    }

    /// A number in a column of this kind, as it is shown.
    pub(super) fn shown(self, number: f64) -> Shown {
        match self {
            ColumnKind::Class => {
                let class = Class::of(number);
                Shown::Code(class_code(class), class.name())
            }
            ColumnKind::Status => {
                let status = Status::of(number);
                Shown::Code(status_code(status), status.name())
            }
            ColumnKind::Count => Shown::Count(CellValue::of(number)),
            ColumnKind::Number => Shown::Number(number),
            ColumnKind::Time => Shown::Time(CellValue::of(number)),
        }
    }
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

/// The value of a cell in a column: a field of its [`Outcome`]. Each is a number, which f64 has exactly.
pub(super) trait CellValue: Copy {
    /// The kind of its columns.
    const KIND: ColumnKind;

    /// The value as a number.
    fn number(self) -> f64;

    /// The value that a number is.
    fn of(number: f64) -> Self;
}

impl CellValue for Class {
    const KIND: ColumnKind = ColumnKind::Class;

    fn number(self) -> f64 {
        f64::from(self as u8)
    }

    fn of(number: f64) -> Class {
        Class::ALL[number as usize]
    }
}

/// A status is its place in [`Status::ALL`].
impl CellValue for Status {
    const KIND: ColumnKind = ColumnKind::Status;

    fn number(self) -> f64 {
        f64::from(self as u8)
    }

    fn of(number: f64) -> Status {
        match number as u8 {
            PENDING => Outcome::PENDING.status,
            code => Status::ALL[usize::from(code)],
        }
    }
}

impl CellValue for u32 {
    const KIND: ColumnKind = ColumnKind::Count;

    fn number(self) -> f64 {
        f64::from(self)
    }

    fn of(number: f64) -> u32 {
        number as u32
    }
}

impl CellValue for f64 {
    const KIND: ColumnKind = ColumnKind::Number;

    fn number(self) -> f64 {
        self
    }

    fn of(number: f64) -> f64 {
        number
    }
}

/// A missing time is NaN.
impl CellValue for Option<f64> {
    const KIND: ColumnKind = ColumnKind::Time;

    fn number(self) -> f64 {
        self.unwrap_or(f64::NAN)
    }

    fn of(number: f64) -> Option<f64> {
        Some(number).filter(|time| !time.is_nan())
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
