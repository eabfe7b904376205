//! Several sweeps watched as one.

use std::sync::atomic::{AtomicBool, Ordering};

use super::observer::{Observer, Phase};
use super::progress::Progress;

/// Passes on the cells that several sweeps run, and nothing else of them: who watches is told all their cells at once.
pub struct Several<'a> {
    observer: &'a dyn Observer,
    sweeping: AtomicBool,
}

impl<'a> Several<'a> {
    /// For sweeps of so many cells together; `observer` hears that they begin.
    pub fn of(observer: &'a dyn Observer, cells: usize) -> Several<'a> {
        observer.begins(Phase::Sweeping, cells);
        Several { observer, sweeping: AtomicBool::new(false) }
    }
}

impl Progress for Several<'_> {
    fn advance(&self, cells: usize) {
        if self.sweeping.load(Ordering::Relaxed) {
            self.observer.advance(cells);
        }
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl Observer for Several<'_> {
    fn begins(&self, phase: Phase, _: usize) {
        self.sweeping.store(phase == Phase::Sweeping, Ordering::Relaxed);
    }
}
