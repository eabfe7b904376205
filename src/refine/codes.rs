//! Codes of outcomes. Where neighbouring cells share a code, no cells between them are run: they share the outcome with its corner
//! and, if the block overturns, the number of impacts.

use crate::stepping::outcome::{COUNTED, Class, Outcome};

/// The code of a cell that has not run.
pub const NOT_RUN: u8 = 0;

/// The code of an outcome. The impacts of a block that stands are not part of it, because they are counted only up to the time
/// at which the outcome was proved.
pub fn code(outcome: &Outcome) -> u8 {
    // COUNTED is small.
    let impacts = outcome.counted_impacts().unwrap_or(COUNTED) as u8;
    match outcome.class {
        Class::FullContact => 1,
        Class::Rocking => 2,
        Class::Unresolved => 3,
        Class::OverturnedLeft => 4 + impacts,
        Class::OverturnedRight => 5 + COUNTED as u8 + impacts,
    }
}

/// The class that a code has; the cell must have run.
pub fn class(code: u8) -> Class {
    match code {
        1 => Class::FullContact,
        2 => Class::Rocking,
        3 => Class::Unresolved,
        left if left < 5 + COUNTED as u8 => Class::OverturnedLeft,
        _ => Class::OverturnedRight,
    }
}
