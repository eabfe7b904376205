//! One of several sweeps that are watched as one.

use std::sync::atomic::{AtomicBool, Ordering};

use super::observer::{Observer, Phase};
use super::progress::Progress;

/// Passes on the cells that one of several sweeps runs, and nothing else of it: who watches was told the cells of all
/// of them when the first began.
pub struct OneOfSeveral<'a> {
    observer: &'a dyn Observer,
    /// Set where one of them has failed: the others are to end.
    stopped: &'a AtomicBool,
    sweeping: AtomicBool,
}

impl<'a> OneOfSeveral<'a> {
    /// For a sweep that ends when `stopped` is set.
    pub fn of(observer: &'a dyn Observer, stopped: &'a AtomicBool) -> OneOfSeveral<'a> {
        OneOfSeveral { observer, stopped, sweeping: AtomicBool::new(false) }
    }
}

impl Progress for OneOfSeveral<'_> {
    fn advance(&self, cells: usize) {
        if self.sweeping.load(Ordering::Relaxed) {
            self.observer.advance(cells);
        }
    }

    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed) || self.observer.cancelled()
    }
}

impl Observer for OneOfSeveral<'_> {
    fn begins(&self, phase: Phase, _: usize) {
        self.sweeping.store(phase == Phase::Sweeping, Ordering::Relaxed);
    }
}
