//! How far a stage of a view is: told now and then while its cells run.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde_json::json;

use super::frame::frame;
use topple::work::observer::{Observer, Phase};

/// Time between two words, and before the first one: a stage that is quick is not talked about.
pub const BETWEEN: Duration = Duration::from_millis(300);

/// Watches a stage of a view.
pub struct Watched<'a> {
    stop: &'a AtomicBool,
    stage: &'a str,
    tell: &'a (dyn Fn(Vec<u8>) + Sync),
    done: AtomicUsize,
    total: AtomicUsize,
    told: Mutex<Instant>,
}

impl<'a> Watched<'a> {
    /// From the beginning of a stage on; `stop` ends it, `tell` is handed frames.
    pub fn new(
        stage: &'a str,
        stop: &'a AtomicBool,
        tell: &'a (dyn Fn(Vec<u8>) + Sync),
    ) -> Watched<'a> {
        let [done, total] = [AtomicUsize::new(0), AtomicUsize::new(0)];
        Watched { stop, stage, tell, done, total, told: Mutex::new(Instant::now()) }
    }
}

impl Observer for Watched<'_> {
    fn advance(&self, cells: usize) {
        let done = self.done.fetch_add(cells, Ordering::Relaxed) + cells;
        // Another thread tells it just now.
        let Ok(mut told) = self.told.try_lock() else { return };
        let total = self.total.load(Ordering::Relaxed);
        if told.elapsed() < BETWEEN || done > total {
            return;
        }
        *told = Instant::now();
        let progress = json!({ "stage": self.stage, "done": done, "of": total });
        (self.tell)(frame(json!({ "progress": progress }), &[]));
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn begins(&self, _: Phase, total: usize) {
        // What is stored is whole, whoever panicked.
        let _told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }
}
