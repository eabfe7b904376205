//! What cells must share to be left alone: the outcome, with its corner, and of a block that overturns the impacts.

use crate::stepping::outcome::{COUNTED, Class, Outcome};

/// A cell that has not run.
pub const NOT_RUN: u8 = 0;

/// The code of an outcome: cells of one code need no cells between them. Impacts of a block that stands are counted up
/// to where its end was proved, and say nothing.
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

/// The class of a code of a cell that has run.
pub fn class(code: u8) -> Class {
    match code {
        1 => Class::FullContact,
        2 => Class::Rocking,
        3 => Class::Unresolved,
        left if left < 5 + COUNTED as u8 => Class::OverturnedLeft,
        _ => Class::OverturnedRight,
    }
}
