//! Outcomes whose reading shows how far the work on them is, and ends when it is cancelled.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::observer::Observer;
use crate::results::columns::Column;
use crate::results::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;

/// Outcomes that are read under somebody's eyes, who is informed of cells times columns.
pub struct ObservedOutcomes<'a> {
    outcomes: &'a dyn Outcomes,
    observer: &'a dyn Observer,
}

impl<'a> ObservedOutcomes<'a> {
    /// Outcomes whose reading `observer` hears of.
    pub fn new(outcomes: &'a dyn Outcomes, observer: &'a dyn Observer) -> ObservedOutcomes<'a> {
        ObservedOutcomes { outcomes, observer }
    }
}

impl Outcomes for ObservedOutcomes<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        if self.observer.cancelled() {
            return Err(io::Error::new(io::ErrorKind::Interrupted, "cancelled"));
        }
        self.observer.advance(cells.len() * columns.len());
        self.outcomes.read(cells, columns)
    }
}
