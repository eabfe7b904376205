//! A sweep tile by tile, by one worker or by several: what is done is handed over while the rest goes on.

use std::collections::VecDeque;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use super::backend::Swept;
use super::gpu::GpuError;
use crate::stepping::outcome::Outcome;

/// What sweeps the cells of a tile: a backend with its plan, or in a test its double.
pub type Worker<'a> = Box<dyn Fn(Range<usize>) -> Result<Swept, GpuError> + Sync + 'a>;

/// What a sweep took.
#[derive(Debug, Default)]
pub struct Took {
    /// Time of the sweep: of the worker that swept longest.
    pub elapsed: Duration,
    /// Time of compiling shaders, of the worker that compiled longest.
    pub compile: Duration,
    /// Workers that failed while others went on, each with its error.
    pub lost: Vec<(usize, GpuError)>,
}

/// Why a sweep stopped.
#[derive(Debug, thiserror::Error)]
pub enum TiledError<E> {
    /// The last worker failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// What was done could not be handed over.
    #[error("{0}")]
    Keep(E),
}

/// How many cells a tile has: what a worker does in some seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// Cells of each worker's first tile.
    pub first: usize,
    /// Most cells of a tile.
    pub most: usize,
    /// Time that a tile is to take.
    pub takes: Duration,
}

/// Most times as many cells as in the worker's last tile: cells differ.
const GROWTH: f64 = 4.0;

impl Sizes {
    /// Tiles of so many cells, however long they take.
    pub fn fixed(cells: usize) -> Sizes {
        Sizes { first: cells, most: cells, takes: Duration::MAX }
    }

    /// Cells of the tile after one of so many cells that took so long.
    fn after(&self, cells: usize, elapsed: Duration) -> usize {
        let share = self.takes.as_secs_f64() / elapsed.as_secs_f64().max(1.0e-9);
        let next = cells as f64 * share.min(GROWTH);
        (next as usize).clamp(1, self.most.max(1))
    }
}

/// Tiles that may wait to be kept.
const BACKLOG: usize = 3;

/// Workers, and the cells that they have not begun.
struct Pool {
    queue: VecDeque<Range<usize>>,
    /// Cells of each worker's next tile.
    sizes: Vec<usize>,
    orders: Vec<mpsc::Sender<Range<usize>>>,
    idle: Vec<usize>,
    running: usize,
}

impl Pool {
    /// Gives every idle worker a tile, while there are any.
    fn dispatch(&mut self) {
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

/// Runs the `missing` cells in tiles of these sizes on workers of one kind, each taking the next when it is
/// done; `keep` is handed every tile as it comes, by its first cell. A worker that fails takes no
/// more, and its tile goes to another.
///
/// # Errors
/// The error of the worker that failed last, when none is left; those of `keep`. What `keep` was
/// handed before stays as it is.
pub fn sweep<E: Send>(
    workers: &[Worker],
    missing: &[Range<usize>],
    sizes: Sizes,
    mut keep: impl FnMut(usize, &[Outcome]) -> Result<(), E> + Send,
) -> Result<Took, TiledError<E>> {
    let mut took = Took::default();
    let mut times = vec![(Duration::ZERO, Duration::ZERO); workers.len()];
    let left = thread::scope(|scope| {
        let (report, reports) = mpsc::channel();
        let mut orders = Vec::with_capacity(workers.len());
        for (number, worker) in workers.iter().enumerate() {
            let (order, ordered) = mpsc::channel();
            let report = report.clone();
            scope.spawn(move || work(number, worker, ordered, report));
            orders.push(order);
        }
        let mut pool = Pool {
            queue: missing.iter().filter(|cells| !cells.is_empty()).cloned().collect(),
            sizes: vec![sizes.first.clamp(1, sizes.most.max(1)); workers.len()],
            orders,
            idle: (0..workers.len()).rev().collect(),
            running: 0,
        };
        // What is done is kept while the workers go on, unless that takes much longer than the work.
        let (done, to_keep) = mpsc::sync_channel::<(usize, Vec<Outcome>)>(BACKLOG);
        let keeper = scope
            .spawn(move || to_keep.iter().try_for_each(|(first, outcomes)| keep(first, &outcomes)));
        pool.dispatch();
        while pool.running > 0
            && let Ok((worker, cells, swept)) = reports.recv()
        {
            pool.running -= 1;
            match swept {
                Err(error) => {
                    pool.queue.push_front(cells);
                    took.lost.push((worker, error));
                    pool.dispatch();
                }
                Ok(swept) => {
                    times[worker].0 += swept.elapsed;
                    times[worker].1 += swept.compile;
                    // A last tile that is cut short says no less of the worker's speed.
                    pool.sizes[worker] = sizes.after(cells.len(), swept.elapsed);
                    pool.idle.push(worker);
                    pool.dispatch();
                    if done.send((cells.start, swept.outcomes)).is_err() {
                        // The keeper has ended, with an error.
                        break;
                    }
                }
            }
        }
        drop(done);
        match keeper.join() {
            Ok(Ok(())) => Ok(pool.queue.len()),
            Ok(Err(error)) => Err(TiledError::Keep(error)),
            Err(panic) => resume_unwind(panic),
        }
    })?;
    if left > 0
        && let Some((_, error)) = took.lost.pop()
    {
        return Err(error.into());
    }
    took.elapsed = times.iter().map(|(elapsed, _)| *elapsed).max().unwrap_or_default();
    took.compile = times.iter().map(|(_, compile)| *compile).max().unwrap_or_default();
    Ok(took)
}

/// What a worker tells of a tile: its number, the cells, what became of them.
type Told = (usize, Range<usize>, Result<Swept, GpuError>);

/// Sweeps one tile after another, as they are ordered.
fn work(
    number: usize,
    worker: &Worker,
    orders: mpsc::Receiver<Range<usize>>,
    report: mpsc::Sender<Told>,
) {
    for cells in orders {
        // A driver may take its thread with it; the others are to hear of it, not to wait for ever.
        let swept = catch_unwind(AssertUnwindSafe(|| worker(cells.clone())));
        let swept = swept.unwrap_or(Err(GpuError::BrokeOff));
        // Nobody hears it where the sweep has ended with an error.
        if report.send((number, cells, swept)).is_err() {
            return;
        }
    }
}
