//! Observers of a sweep: they are told of its phases and its progress, and can end it.

use std::sync::atomic::{AtomicBool, Ordering};

/// What a sweep is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Cells are run; a cell that runs twice counts twice.
    Sweeping,
    /// Cells beside a boundary between outcomes run again with a smaller step; those whose outcome changes run once more.
    Repairing,
    /// Cells of a finer grid are run.
    Refining,
    /// Outcomes are counted; the unit of progress is a cell times a column.
    Counting,
    /// The reference's sample is chosen, in cells times columns: one of all cells twice, and all of the sample.
    Choosing,
    /// The reference runs its sample; the unit of progress is a cell.
    Verifying,
    /// Fragilities are fitted; the unit of progress is a cell times a limit state.
    Fitting,
    /// Files are written; the unit of progress is a cell.
    Writing,
}

/// Is told of the phases and the progress of a sweep, and can end it.
pub trait Observer: Sync {
    /// Called when a phase begins, with the amount of work in it.
    fn begins(&self, phase: Phase, total: usize) {
        let _ = (phase, total);
    }

    /// Called with the number of cells that were done since the last call.
    fn advance(&self, cells: usize) {
        let _ = cells;
    }

    /// True when the work is to end; it then ends within a tenth of a second. Every thread asks many times a second.
    fn cancelled(&self) -> bool {
        false
    }
}

/// No observer: the work goes on to its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Observer for Unwatched {}

/// A flag that ends a sweep when it is set.
impl Observer for AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}
