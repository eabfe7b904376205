//! Snapshots of the outcomes of a batch that is still running, on their way from a backend to who saves them:
//! in the grid's order, and as they will be at the end.

use std::ops::Range;

use super::plan::Part;
use super::progress::Progress;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Passes snapshots of a part's cells on as those of the whole batch.
pub struct OfPart<'a> {
    /// Who hears.
    pub progress: &'a dyn Progress,
    /// The batch.
    pub cells: &'a Range<usize>,
    /// The part, some of its cells.
    pub part: &'a Part,
}

impl Progress for OfPart<'_> {
    fn advance(&self, cells: usize) {
        self.progress.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled()
    }

    fn wants_snapshot(&self) -> bool {
        self.progress.wants_snapshot()
    }

    fn snapshot(&self, outcomes: &[Outcome]) {
        let mut all = vec![Outcome::PENDING; self.cells.len()];
        for (&cell, outcome) in self.part.cells.iter().zip(outcomes) {
            all[cell - self.cells.start] = self.part.told(*outcome);
        }
        self.progress.snapshot(&all);
    }
}

impl Part {
    /// The outcome of a cell of it: one whose vertical direction is locked says so.
    pub(super) fn told(&self, mut outcome: Outcome) -> Outcome {
        if self.vertical_locked && matches!(outcome.status, Status::Ok | Status::Proved) {
            outcome.status = Status::VerticalLocked;
        }
        outcome
    }
}

/// Hears of a first run of cells, whose outcomes nobody is to have.
pub struct FirstRun<'a>(pub &'a dyn Progress);

impl Progress for FirstRun<'_> {
    fn advance(&self, cells: usize) {
        self.0.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Hears of the second run of cells, whose outcomes are compared with those of the first.
pub struct SecondRun<'a> {
    /// Who hears.
    pub progress: &'a dyn Progress,
    /// The first run's outcomes.
    pub first: &'a [Outcome],
}

impl Progress for SecondRun<'_> {
    fn advance(&self, cells: usize) {
        self.progress.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled()
    }

    fn wants_snapshot(&self) -> bool {
        self.progress.wants_snapshot()
    }

    fn snapshot(&self, outcomes: &[Outcome]) {
        let mut all = outcomes.to_vec();
        resolve(&mut all, self.first);
        self.progress.snapshot(&all);
    }
}

/// Calls cells unresolved that another run classifies otherwise; those that have not run stay so.
pub fn resolve(outcomes: &mut [Outcome], other: &[Outcome]) {
    for (cell, other) in outcomes.iter_mut().zip(other) {
        if cell.class != other.class && cell.class != Class::Unresolved {
            (cell.class, cell.status) = (Class::Unresolved, Status::Undecided);
        }
    }
}
