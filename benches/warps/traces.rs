//! The trials of every cell of a sweep, as the lanes of the CPU make them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::atomic::{AtomicUsize, Ordering};

use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::real::{Real, Vector};
use topple::scene::Grid;
use topple::stepping::lanes::{Feed, Job, Lanes, Shared};
use topple::stepping::log::Listener;
use topple::stepping::state::State;
use topple::stepping::trials::{Purpose, Trial};
use topple::work::observer::Unwatched;

/// Cells that a thread takes at once: as many as the sweep's.
pub const BATCH: usize = 64;

const ROCKING: u8 = 16;
const AT_EDGE: u8 = 32;

/// A trial in a byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Packed(u8);

impl Packed {
    /// A trial.
    pub fn of(trial: Trial) -> Packed {
        let rocking = if trial.rocking { ROCKING } else { 0 };
        Packed(trial.purpose as u8 | rocking | if trial.at_edge { AT_EDGE } else { 0 })
    }

    /// What it was for.
    pub fn purpose(self) -> Purpose {
        Purpose::ALL[usize::from(self.0 % ROCKING)]
    }

    /// The block rocked.
    pub fn rocking(self) -> bool {
        self.0 & ROCKING != 0
    }

    /// The cell may leave its thread after it.
    pub fn at_edge(self) -> bool {
        self.0 & AT_EDGE != 0
    }
}

/// The trials of a sweep's cells; none of a cell that is done before it begins.
#[derive(Debug, Default)]
pub struct Traces {
    trials: Vec<Packed>,
    ends: Vec<usize>,
}

impl Traces {
    /// Cells.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// A cell's.
    pub fn of(&self, cell: usize) -> &[Packed] {
        let from = if cell == 0 { 0 } else { self.ends[cell - 1] };
        &self.trials[from..self.ends[cell]]
    }

    /// All cells'.
    pub fn all(&self) -> &[Packed] {
        &self.trials
    }

    /// Adds the next cell's.
    pub fn add(&mut self, trials: &[Packed]) {
        self.trials.extend_from_slice(trials);
        self.ends.push(self.trials.len());
    }
}

/// Turns of a thread's lanes that take cell after cell of a list, each the next when its own has
/// ended.
pub fn turns(traces: &Traces, cells: impl Iterator<Item = usize>, lanes: usize) -> usize {
    let mut free: BinaryHeap<_> = (0..lanes).map(|lane| Reverse((0, lane))).collect();
    for cell in cells.filter(|&cell| !traces.of(cell).is_empty()) {
        if let Some(Reverse((at, lane))) = free.pop() {
            free.push(Reverse((at + traces.of(cell).len(), lane)));
        }
    }
    free.into_iter().map(|Reverse((at, _))| at).max().unwrap_or(0)
}

struct Recorder {
    turns: usize,
    trials: Vec<Vec<Packed>>,
}

impl<V: Vector> Listener<V> for &mut Recorder {
    const TRIALS: bool = true;

    fn tried(&mut self, trials: impl Iterator<Item = (usize, Trial)>) {
        self.turns += 1;
        for (cell, trial) in trials {
            self.trials[cell].push(Packed::of(trial));
        }
    }
}

struct Queue<'a, R> {
    all: &'a Cells<'a, R>,
    next: &'a AtomicUsize,
    batch: std::ops::Range<usize>,
    count: usize,
    ended: Vec<(usize, State<R>)>,
}

impl<R: Real> Feed<R> for Queue<'_, R> {
    fn next(&mut self) -> Option<Job<R>> {
        if self.batch.is_empty() {
            let from = self.next.fetch_add(BATCH, Ordering::Relaxed).min(self.count);
            self.batch = from..(from + BATCH).min(self.count);
        }
        let number = self.batch.next()?;
        let (cell, state) = self.all.begin(number);
        Some(Job { number, cell, state })
    }

    fn done(&mut self, job: &Job<R>) {
        self.ended.push((job.number, job.state));
    }
}

/// Sweeps a grid on vectors like `zero`: its cells' trials and last states, and the turns of all
/// threads.
pub fn record<V: Vector + Send + Sync>(
    plan: &Plan,
    grid: &Grid,
    zero: V,
) -> (Traces, Vec<State<V::Element>>, usize) {
    let record = plan.record::<V::Element>();
    let cells: Vec<usize> = (0..grid.len()).collect();
    let all = Cells::<V::Element>::of(plan, grid, &cells, &record, &Unwatched);
    let shared = Shared { variant: plan.variant(), models: all.bodies(), record: &record };
    let count = grid.len();
    let next = AtomicUsize::new(0);
    let mut ran = rayon::broadcast(|_| {
        let ended = Vec::with_capacity(count);
        let mut queue = Queue { all: &all, next: &next, batch: 0..0, count, ended };
        let mut to = Recorder { turns: 0, trials: vec![Vec::new(); count] };
        Lanes::new(shared, zero, &mut to).run(&mut queue);
        (to, queue.ended)
    });
    let mut states: Vec<_> = ran.iter_mut().flat_map(|(_, ended)| std::mem::take(ended)).collect();
    states.sort_by_key(|(number, _)| *number);
    let mut traces = Traces::default();
    for cell in 0..count {
        // No more than one thread has a cell's.
        let trials = ran.iter_mut().map(|(to, _)| std::mem::take(&mut to.trials[cell]));
        traces.add(&trials.flatten().collect::<Vec<_>>());
    }
    let turns = ran.iter().map(|(to, _)| to.turns).sum();
    (traces, states.into_iter().map(|(_, state)| state).collect(), turns)
}
