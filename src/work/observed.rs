//! Outcomes whose reading shows how far the work on them is, and ends when it is cancelled.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::progress::Progress;
use crate::results::columns::Column;
use crate::results::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;

/// Outcomes that are read under somebody's eyes, who hears of cells times columns.
pub struct ObservedOutcomes<'a> {
    outcomes: &'a dyn Outcomes,
    progress: &'a dyn Progress,
}

impl<'a> ObservedOutcomes<'a> {
    /// Outcomes whose reading `progress` hears of.
    pub fn new(outcomes: &'a dyn Outcomes, progress: &'a dyn Progress) -> ObservedOutcomes<'a> {
        ObservedOutcomes { outcomes, progress }
    }
}

impl Outcomes for ObservedOutcomes<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        if self.progress.cancelled() {
            return Err(io::Error::new(io::ErrorKind::Interrupted, "cancelled"));
        }
        self.progress.advance(cells.len() * columns.len());
        self.outcomes.read(cells, columns)
    }
}
