//! One of several sweeps that are watched as one.

use std::sync::atomic::{AtomicBool, Ordering};

use topple::work::observer::{Observer, Phase};

/// Passes on the cells that one of several sweeps runs, and nothing else of it: the observer was told the cells of all
/// of them when the first began.
pub struct OneOfSeveral<'a> {
    observer: &'a dyn Observer,
    /// Set where one of them has failed: the others are to end.
    stopped: Option<&'a AtomicBool>,
    sweeping: AtomicBool,
}

impl<'a> OneOfSeveral<'a> {
    /// For a sweep that ends when `stopped` is set, or the observer ends it.
    pub fn of(observer: &'a dyn Observer, stopped: Option<&'a AtomicBool>) -> OneOfSeveral<'a> {
        OneOfSeveral { observer, stopped, sweeping: AtomicBool::new(false) }
    }
}

impl Observer for OneOfSeveral<'_> {
    fn begins(&self, phase: Phase, _: usize) {
        self.sweeping.store(phase == Phase::Sweeping, Ordering::Relaxed);
    }

    fn advance(&self, cells: usize) {
        if self.sweeping.load(Ordering::Relaxed) {
            self.observer.advance(cells);
        }
    }

    fn cancelled(&self) -> bool {
        self.stopped.is_some_and(|stopped| stopped.load(Ordering::Relaxed))
            || self.observer.cancelled()
    }
}
