//! Outcomes that report the progress of reading them, and whose reading ends when the work is cancelled.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::columns::Column;
use super::outcomes::Outcomes;
use super::values::ColumnValues;
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;
use crate::work::observer::Observer;

/// Outcomes with an observer of their reading. The unit of progress is a cell times a column.
pub struct ObservedOutcomes<'a> {
    outcomes: &'a dyn Outcomes,
    observer: &'a dyn Observer,
}

impl<'a> ObservedOutcomes<'a> {
    /// Outcomes whose reading is reported to `observer`.
    pub fn new(outcomes: &'a dyn Outcomes, observer: &'a dyn Observer) -> ObservedOutcomes<'a> {
        ObservedOutcomes { outcomes, observer }
    }
}

impl ObservedOutcomes<'_> {
    /// Reports a number of cells times columns; an error where the work was cancelled.
    fn report(&self, count: usize) -> io::Result<()> {
        if self.observer.cancelled() {
            return Err(io::Error::new(io::ErrorKind::Interrupted, "cancelled"));
        }
        self.observer.advance(count);
        Ok(())
    }
}

impl Outcomes for ObservedOutcomes<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.report(cells.len() * columns.len())?;
        self.outcomes.read(cells, columns)
    }

    fn column(
        &self,
        cells: Range<usize>,
        column: Column,
        precision: Precision,
    ) -> io::Result<ColumnValues> {
        self.report(cells.len())?;
        self.outcomes.column(cells, column, precision)
    }
}
