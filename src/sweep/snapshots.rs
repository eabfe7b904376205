//! Snapshots of the outcomes of a batch that is still running, on their way from a backend to who saves them:
//! in the grid's order, and as they will be at the end.

use super::plan::Part;
use super::progress::Progress;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Makes outcomes of a run what they are for who hears.
type Change<'a> = dyn Fn(Vec<Outcome>) -> Vec<Outcome> + Sync + 'a;

/// Passes on what a run tells, its snapshots changed; or without any, of a run whose outcomes nobody is to have.
pub struct PassedOn<'a> {
    /// Who hears.
    pub progress: &'a dyn Progress,
    /// What becomes of snapshots; none are taken without it.
    pub change: Option<&'a Change<'a>>,
}

impl Progress for PassedOn<'_> {
    fn advance(&self, cells: usize) {
        self.progress.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled()
    }

    fn wants_snapshot(&self) -> bool {
        self.change.is_some() && self.progress.wants_snapshot()
    }

    fn snapshot(&self, outcomes: Vec<Outcome>) {
        if let Some(change) = self.change {
            self.progress.snapshot(change(outcomes));
        }
    }
}

impl Part {
    /// The outcome of a cell of it: one whose vertical direction is locked says so.
    fn told(&self, mut outcome: Outcome) -> Outcome {
        if self.vertical_locked && matches!(outcome.status, Status::Ok | Status::Proved) {
            outcome.status = Status::VerticalLocked;
        }
        outcome
    }

    /// Its outcomes as they are told.
    pub(super) fn all_told(&self, mut outcomes: Vec<Outcome>) -> Vec<Outcome> {
        if self.vertical_locked {
            outcomes.iter_mut().for_each(|outcome| *outcome = self.told(*outcome));
        }
        outcomes
    }

    /// Its outcomes among those of a list of so many cells, the others pending.
    pub(super) fn among(&self, count: usize, outcomes: Vec<Outcome>) -> Vec<Outcome> {
        if outcomes.len() == count {
            // A part alone holds every cell, in order.
            return outcomes;
        }
        let mut all = vec![Outcome::PENDING; count];
        for (&place, outcome) in self.places.iter().zip(outcomes) {
            all[place] = outcome;
        }
        all
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
