//! The sweep on the vectors of the CPU: threads whose lanes take cells from one queue.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use fearless_simd::Level;

use super::cell_run::CellRun;
use super::order::begin_order;
use super::sink::{Sink, collected};
use crate::cells::listing::CellAt;
use crate::cells::ready::Cells;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::results::block::Block;
use crate::stepping::lanes::{Feed, Job, Lanes, Shared};
use crate::stepping::long_step::LongSteps;
use crate::stepping::outcome::Outcome;
use crate::stepping::phases::{Phases, RecordFeed};
use crate::work::observer::Observer;
use crate::work::threads::install;
use crate::work::vectors::vectorized;

/// The number of cells that a thread takes from the queue, and of outcomes that it returns, at once: several, because all threads
/// share the queue and the outcomes.
const AT_ONCE: usize = 64;

/// The cells that a thread takes from the queue and the outcomes that it returns, several at a time.
struct ThreadFeed<'a, R> {
    cells: usize,
    sink: Sink<'a>,
    observer: &'a dyn Observer,
    all: &'a Cells<'a, R>,
    /// See [`begin_order`]; under a pulse without shared motions the order of the list.
    order: Option<&'a [u32]>,
    queue: &'a AtomicUsize,
    taken: Range<usize>,
    /// The outcomes of cells that have ended, and the numbers of these cells.
    ended: Vec<Outcome>,
    numbers: Vec<usize>,
}

impl<R: Real> ThreadFeed<'_, R> {
    /// Hands over the outcomes of cells that have ended.
    fn deliver(&mut self) {
        self.observer.advance(self.ended.len());
        self.sink.put(&self.numbers, &self.ended);
        self.ended.clear();
        self.numbers.clear();
    }
}

impl<R: Real> Feed<R> for ThreadFeed<'_, R> {
    #[inline(always)]
    fn next(&mut self) -> Option<Job<R>> {
        if self.taken.is_empty() {
            if self.cancelled() {
                return None;
            }
            let from = self.queue.fetch_add(AT_ONCE, Ordering::Relaxed).min(self.cells);
            self.taken = from..(from + AT_ONCE).min(self.cells);
        }
        let place = self.taken.next()?;
        let number = self.order.map_or(place, |order| order[place] as usize);
        let (cell, state) = self.all.begin(number);
        Some(Job { number, cell, state })
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }

    #[inline(always)]
    fn done(&mut self, job: &Job<R>) {
        self.ended.push(self.all.outcome(job.number, &job.state));
        self.numbers.push(job.number);
        if self.ended.len() == AT_ONCE {
            self.deliver();
        }
    }
}

impl<R: Real> RecordFeed<R> for ThreadFeed<'_, R> {
    fn long_steps(&self, number: usize) -> LongSteps<R> {
        self.all.long_steps(number)
    }
}

/// Runs cells on all cores with the vectors of a level, once each, and collects their outcomes; see [`sweep_into`].
pub fn sweep(run: &CellRun, observer: &dyn Observer, level: Level) -> Block {
    let into = |sink: Sink| sweep_into(run, sink, observer, level);
    collected(run.cells.len(), run.precision, into).0
}

/// Runs cells on all cores with the vectors of a level, once each, and hands over their outcomes; `observer` is told of
/// cells that are done. The function is not generic, so that its callers do not compile all kinds of vectors again.
pub fn sweep_into(run: &CellRun, sink: Sink, observer: &dyn Observer, level: Level) {
    match run.precision {
        Precision::F32 => on_lanes::<f32>(run, sink, observer, level),
        Precision::F64 => on_lanes::<f64>(run, sink, observer, level),
    }
}

fn on_lanes<R: Real>(run: &CellRun, sink: Sink, observer: &dyn Observer, level: Level) {
    let CellRun { plan, grid, cells, .. } = *run;
    let record = plan.record::<R>();
    let all = Cells::of(plan, grid, cells, &record, observer);
    let shared = Shared { variant: plan.variant(), models: all.bodies(), record: &record };
    let (recorded, motions) = (shared.variant.recorded, all.of_motions.as_ref());
    let substeps = |cell: &CellAt| if recorded { all.tables.clock(cell).substeps } else { 1 };
    let order =
        (recorded || motions.is_some()).then(|| begin_order(motions, (grid, cells), substeps));
    let queue = AtomicUsize::new(0);
    install(|| {
        rayon::broadcast(|_| {
            let mut feed = ThreadFeed {
                cells: cells.len(),
                sink,
                observer,
                all: &all,
                order: order.as_deref(),
                queue: &queue,
                taken: 0..0,
                ended: Vec::with_capacity(AT_ONCE),
                numbers: Vec::with_capacity(AT_ONCE),
            };
            let zero = R::of(0.0);
            if recorded {
                let long = plan.takes_long_steps();
                vectorized!(level, zero => Phases::new(shared, long, zero).run(&mut feed));
            } else {
                vectorized!(level, zero => Lanes::new(shared, zero).run(&mut feed));
            }
            feed.deliver();
        })
    });
}

/// The vector instructions of this machine, the narrowest first: names and levels.
pub fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let levels = [
        ("one lane", best.as_avx2().is_none().then_some(best)),
        ("AVX2", best.as_avx2().map(Level::Avx2)),
        ("AVX-512", best.as_avx512().map(Level::Avx512)),
    ];
    #[cfg(target_arch = "aarch64")]
    let levels = [("NEON", best.as_neon().map(Level::Neon))];
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let levels = [("one lane", Some(best))];
    levels.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}
