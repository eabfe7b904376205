//! A sweep in batches, by one or several workers.

use std::collections::VecDeque;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use crate::backend::backend_error::BackendError;
use crate::backend::ready::RunTimes;
use crate::work::threads::Threads;

/// What sweeps the cells of a batch: a backend with its plan and the sink for the outcomes, or a substitute in a test.
pub type Worker<'a> = Box<dyn Fn(Range<usize>) -> Result<RunTimes, BackendError> + Sync + 'a>;

/// The time that the work took, and the workers that were lost.
#[derive(Debug, Default)]
pub struct WorkReport {
    /// Time of the sweep: that of the worker that swept longest.
    pub elapsed: Duration,
    /// Time of compiling shaders: that of the worker that compiled longest.
    pub compile: Duration,
    /// Workers that failed while others went on, each with its error.
    pub lost: Vec<(usize, BackendError)>,
}

/// The sizes of batches: as many cells as a worker runs in some seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// The number of cells of the first batch of each worker.
    pub first: usize,
    /// The largest number of cells of a batch.
    pub most: usize,
    /// The time that a batch should take.
    pub takes: Duration,
}

/// The largest factor by which a batch may have more cells than the last one of the same worker, because cells differ.
const GROWTH: f64 = 4.0;

impl Sizes {
    /// Batches of a fixed number of cells, however long they take.
    pub fn fixed(cells: usize) -> Sizes {
        Sizes { first: cells, most: cells, takes: Duration::MAX }
    }

    /// Cells of the batch after one of a given number of cells that took so long.
    fn after(&self, cells: usize, elapsed: Duration) -> usize {
        let share = self.takes.as_secs_f64() / elapsed.as_secs_f64().max(1.0e-9);
        let next = cells as f64 * share.min(GROWTH);
        (next as usize).clamp(1, self.most.max(1))
    }
}

/// The workers, and the cells that no worker has begun.
struct Pool {
    queue: VecDeque<Range<usize>>,
    /// Cells of each worker's next batch.
    sizes: Vec<usize>,
    orders: Vec<mpsc::Sender<Range<usize>>>,
    idle: Vec<usize>,
    running: usize,
}

impl Pool {
    /// Gives every idle worker a batch, as long as cells are left.
    fn hand_out(&mut self) {
        while let Some(worker) = self.idle.pop() {
            let Some(mut cells) = self.queue.pop_front() else {
                self.idle.push(worker);
                return;
            };
            let end = cells.start.saturating_add(self.sizes[worker]);
            if end < cells.end {
                self.queue.push_front(end..cells.end);
                cells.end = end;
            }
            // A worker hears its orders until the pool is gone.
            let _ = self.orders[worker].send(cells);
            self.running += 1;
        }
    }
}

/// Runs the `missing` cells in batches of these sizes on workers of one kind, each taking the next when it is
/// done. A worker that fails takes no more, and its batch goes to another.
///
/// # Errors
/// The error of the worker that failed last, when none is left; that it was cancelled.
pub fn sweep(
    workers: &[Worker],
    missing: &[Range<usize>],
    sizes: Sizes,
) -> Result<WorkReport, BackendError> {
    let mut took = WorkReport::default();
    let mut times = vec![(Duration::ZERO, Duration::ZERO); workers.len()];
    let mut cancelled = false;
    let left = thread::scope(|scope| {
        let (report, reports) = mpsc::channel();
        let mut orders = Vec::with_capacity(workers.len());
        for (number, worker) in workers.iter().enumerate() {
            let (order, ordered) = mpsc::channel();
            let report = report.clone();
            let threads = Threads::current();
            scope.spawn(move || threads.scope(|| work(number, worker, ordered, report)));
            orders.push(order);
        }
        let mut pool = Pool {
            queue: missing.iter().filter(|cells| !cells.is_empty()).cloned().collect(),
            sizes: vec![sizes.first.clamp(1, sizes.most.max(1)); workers.len()],
            orders,
            idle: (0..workers.len()).rev().collect(),
            running: 0,
        };
        pool.hand_out();
        while pool.running > 0
            && let Ok((worker, cells, ran)) = reports.recv()
        {
            pool.running -= 1;
            match ran {
                // The others end, too: they are asked the same.
                Err(BackendError::Cancelled) => {
                    cancelled = true;
                    pool.queue.clear();
                }
                Err(error) => {
                    pool.queue.push_front(cells);
                    took.lost.push((worker, error));
                    pool.hand_out();
                }
                Ok(ran) => {
                    times[worker].0 += ran.elapsed;
                    times[worker].1 += ran.compile;
                    // A last batch that is cut short says no less of the worker's speed.
                    pool.sizes[worker] = sizes.after(cells.len(), ran.elapsed);
                    pool.idle.push(worker);
                    pool.hand_out();
                }
            }
        }
        pool.queue.len()
    });
    if cancelled {
        return Err(BackendError::Cancelled);
    }
    if left > 0
        && let Some((_, error)) = took.lost.pop()
    {
        return Err(error);
    }
    took.elapsed = times.iter().map(|(elapsed, _)| *elapsed).max().unwrap_or_default();
    took.compile = times.iter().map(|(_, compile)| *compile).max().unwrap_or_default();
    Ok(took)
}

/// What a worker reports about a batch: the number of the worker, the cells, and the time that they took.
type BatchDone = (usize, Range<usize>, Result<RunTimes, BackendError>);

/// Sweeps one batch after another, as they are ordered.
fn work(
    number: usize,
    worker: &Worker,
    orders: mpsc::Receiver<Range<usize>>,
    report: mpsc::Sender<BatchDone>,
) {
    for cells in orders {
        // A driver may take its thread with it; the others are to hear of it, not to wait for ever.
        let ran = catch_unwind(AssertUnwindSafe(|| worker(cells.clone())));
        let ran = ran.unwrap_or(Err(BackendError::BrokeOff));
        // Nobody hears it where the sweep has ended.
        if report.send((number, cells, ran)).is_err() {
            return;
        }
    }
}
