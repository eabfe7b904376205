//! Something that runs while something else does.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use topple::backend::report::threads;
use topple::work::observer::{Observer, Phase};
use topple::work::threads::Threads;

use super::progress::Screen;

/// Hears of cells of the reference: it keeps their number until their bar is shown.
struct Beside<'a> {
    screen: &'a Screen,
    done: AtomicUsize,
    shown: AtomicBool,
    stop: AtomicBool,
}

impl Beside<'_> {
    /// Shows the bar of cells that are still to come.
    fn show(&self, total: usize) {
        self.screen.begins(Phase::Verifying, total);
        self.shown.store(true, Ordering::Relaxed);
        self.screen.advance(self.done.swap(0, Ordering::Relaxed));
    }
}

impl Observer for Beside<'_> {
    fn advance(&self, cells: usize) {
        self.done.fetch_add(cells, Ordering::Relaxed);
        if self.shown.load(Ordering::Relaxed) {
            self.screen.advance(self.done.swap(0, Ordering::Relaxed));
        }
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.screen.cancelled()
    }
}

/// Runs `work`, and `verify` of a given number of cells, where there is one: at the same time if more threads than one are allowed.
/// If the work fails, `verify` is asked to end.
pub fn run<T, V: Send>(
    screen: &Screen,
    total: usize,
    work: impl FnOnce() -> anyhow::Result<T>,
    verify: Option<impl FnOnce(&dyn Observer) -> V + Send>,
) -> anyhow::Result<(T, Option<V>)> {
    let Some(verify) = verify else { return Ok((work()?, None)) };
    let [shown, stop] = [(); 2].map(|()| AtomicBool::new(false));
    let watched = Beside { screen, done: AtomicUsize::new(0), shown, stop };
    if threads() == 1 {
        let worked = work()?;
        watched.show(total);
        return Ok((worked, Some(verify(&watched))));
    }
    // On threads of its own, where there are more: on those of the work it would keep this waiting.
    let own = Threads::new(NonZeroUsize::new(threads())).unwrap_or_default();
    thread::scope(|scope| {
        let verifying = scope.spawn(|| own.scope(|| verify(&watched)));
        let worked = work();
        match &worked {
            Ok(_) => watched.show(total),
            Err(_) => watched.stop.store(true, Ordering::Relaxed),
        }
        let verified = verifying.join().unwrap_or_else(|panic| resume_unwind(panic));
        Ok((worked?, Some(verified)))
    })
}
