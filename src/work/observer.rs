//! Who watches a sweep: its phases and its cells; and may end it.

use std::sync::atomic::{AtomicBool, Ordering};

use super::progress::{Progress, Unwatched};

/// What a sweep is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Cells run; those that run twice count twice.
    Sweeping,
    /// Cells beside a boundary between outcomes run again, more finely; those that change once more.
    Repairing,
    /// Cells of a finer grid run.
    Refining,
    /// Outcomes are counted, in cells times columns.
    Counting,
    /// The reference's sample is chosen, in cells times columns: one of all cells twice, and all of the sample.
    Choosing,
    /// The reference runs its sample, in cells.
    Verifying,
    /// Fragilities are fitted, in cells times limit states.
    Fitting,
    /// Files are written, in cells.
    Writing,
}

/// Hears of a sweep's phases and progress; its [`Progress::cancelled`] ends the sweep within a tenth of a
/// second.
pub trait Observer: Progress {
    /// Hears that a phase begins, and how much there is to do.
    fn begins(&self, phase: Phase, total: usize) {
        let _ = (phase, total);
    }
}

impl Observer for Unwatched {}

/// A flag that ends a sweep when it is set.
impl Progress for AtomicBool {
    fn advance(&self, _: usize) {}

    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

impl Observer for AtomicBool {}
