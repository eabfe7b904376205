//! Work on a thread of its own, while Python's thread looks for Ctrl-C and shows progress.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use topple::work::threads::Threads;
use topple::{Observer, Phase};

/// Time between two questions whether Ctrl-C was pressed.
const ASKED_EVERY: Duration = Duration::from_millis(20);

/// What is known of work while it goes on.
#[derive(Default)]
pub struct Watch {
    /// Done in the phase.
    done: AtomicUsize,
    cancelled: AtomicBool,
    /// The phase, and how much there is to do in it.
    phase: Mutex<Option<(&'static str, usize)>>,
}

impl Observer for Watch {
    fn advance(&self, cells: usize) {
        self.done.fetch_add(cells, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    fn begins(&self, phase: Phase, total: usize) {
        let name = match phase {
            Phase::Sweeping => "sweep",
            Phase::Repairing => "repair",
            Phase::Refining => "refining",
            Phase::Counting => "counting",
            Phase::Choosing => "sample",
            Phase::Verifying => "reference",
            Phase::Fitting => "fits",
            Phase::Writing => "writing",
            _ => "work",
        };
        self.done.store(0, Ordering::Relaxed);
        *self.phase() = Some((name, total));
    }
}

impl Watch {
    fn phase(&self) -> std::sync::MutexGuard<'_, Option<(&'static str, usize)>> {
        // What is stored is whole, whoever panicked.
        self.phase.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Does work without the interpreter's lock. `progress(phase, done, total)` is called some times a second where it is
/// not None; Ctrl-C, and an exception of `progress`, end the work. What it computes it does on these threads.
///
/// # Errors
/// `KeyboardInterrupt`, the exception of `progress`; what `work` fails with is in its result.
pub fn run<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: &Threads,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    not_forked()?;
    let watch = Watch::default();
    let mut stopped = None;
    let result = thread::scope(|scope| {
        let (sender, receiver) = channel();
        let receiver = Mutex::new(receiver);
        let watch = &watch;
        scope.spawn(move || {
            let result = catch_unwind(AssertUnwindSafe(|| threads.scope(|| work(watch))));
            // The receiver waits for it.
            let _ = sender.send(result);
        });
        loop {
            let received = py.detach(|| {
                // Nobody else locks it.
                let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
                receiver.recv_timeout(ASKED_EVERY)
            });
            match received {
                Ok(result) => break Some(result),
                Err(RecvTimeoutError::Disconnected) => break None,
                Err(RecvTimeoutError::Timeout) => {}
            }
            if stopped.is_none()
                && let Err(error) = py.check_signals().and_then(|()| tell(progress, watch))
            {
                watch.cancelled.store(true, Ordering::Relaxed);
                stopped = Some(error);
            }
        }
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    match result {
        Some(Ok(result)) => tell(progress, &watch).map(|()| result),
        _ => Err(defect()),
    }
}

/// Does work that cannot be ended, without the interpreter's lock: after Ctrl-C it goes on unheard.
///
/// # Errors
/// `KeyboardInterrupt`.
pub fn run_unheard<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    not_forked()?;
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(work));
        // Nobody may wait for it any more.
        let _ = sender.send(result);
    });
    let receiver = Mutex::new(receiver);
    loop {
        let received = py.detach(|| {
            // Nobody else locks it.
            receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(ASKED_EVERY)
        });
        match received {
            Ok(Ok(result)) => return Ok(result),
            Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => return Err(defect()),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
        }
    }
}

fn defect() -> PyErr {
    PyRuntimeError::new_err("a defect of topple ended the work; please report it")
}

/// Refuses a process that was forked from one with calls behind it: the threads of these are not there, and a call
/// would wait for them without end.
fn not_forked() -> PyResult<()> {
    static FIRST: OnceLock<u32> = OnceLock::new();
    if *FIRST.get_or_init(std::process::id) == std::process::id() {
        return Ok(());
    }
    let problem = "this process was forked from one that had called topple; start processes by spawn, as \
                   multiprocessing.set_start_method('spawn')";
    Err(PyRuntimeError::new_err(problem))
}

/// Tells of the progress.
fn tell(progress: Option<&Bound<'_, PyAny>>, watch: &Watch) -> PyResult<()> {
    let phase = *watch.phase();
    if let (Some(progress), Some((name, total))) = (progress, phase) {
        progress.call1((name, watch.done.load(Ordering::Relaxed).min(total), total))?;
    }
    Ok(())
}
