//! Who watches a sweep: hears of its phases and its cells, and may end it.

use std::sync::atomic::{AtomicBool, Ordering};

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

/// Hears of a sweep's phases and of its progress, and may end it.
pub trait Observer: Sync {
    /// Hears that a phase begins, and how much there is to do.
    fn begins(&self, phase: Phase, total: usize) {
        let _ = (phase, total);
    }

    /// Hears of cells that are done since it last heard of some.
    fn advance(&self, cells: usize) {
        let _ = cells;
    }

    /// True when the work is to end, which it does within a tenth of a second. Every thread asks it many times a second.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody watches, and the work goes to its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Observer for Unwatched {}

/// A flag that ends a sweep when it is set.
impl Observer for AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}
