//! The trials of every cell of a sweep: what each was for, as a lane by itself shows from turn to turn.

use std::cell::Cell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::block::FULL_CONTACT;
use topple::model::real::Real;
use topple::scene::Grid;
use topple::stepping::guards::{IMPACT, NOTHING, UPLIFT_LEFT, UPLIFT_RIGHT};
use topple::stepping::lanes::{Job, Lanes, Shared};
use topple::stepping::log::Log;
use topple::stepping::state::{RUNNING, State};
use topple::work::observer::Unwatched;

/// What a trial was for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A whole step.
    Step,
    /// A part of a step: the rest of one, or up to a yield limit.
    Part,
    /// A part of a step up to the impact estimated from the rates.
    Landing,
    /// A step or a part in which a guard has happened: the search begins with it.
    GivenUp,
    /// A trial of a root search that the cell does not move on by.
    Try,
    /// The trial after which a search is over: the cell moves on to the guard, or past where none happens.
    Arrival,
    /// None: the block lifts at once, and the trial is not used.
    Uplift,
}

impl Purpose {
    /// All of them, each at the place of its number.
    pub const ALL: [Purpose; 7] = [
        Purpose::Step,
        Purpose::Part,
        Purpose::Landing,
        Purpose::GivenUp,
        Purpose::Try,
        Purpose::Arrival,
        Purpose::Uplift,
    ];

    /// True where the cell moves on by the trial, or its search narrows.
    pub fn is_useful(self) -> bool {
        self != Purpose::Uplift
    }

    /// True in a search.
    pub fn seeks(self) -> bool {
        matches!(self, Purpose::Try | Purpose::Arrival)
    }
}

/// A cell's trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trial {
    /// What it was for.
    pub purpose: Purpose,
    /// The block rocked.
    pub rocking: bool,
    /// The cell is at the start of a step after it, and nothing is searched for: it may leave.
    pub at_edge: bool,
}

/// Cells that a thread takes at once: as many as the sweep's.
pub const AT_ONCE: usize = 64;

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

/// The last trial of a lane.
struct LastTrial {
    switch: Cell<u32>,
    /// The block rocks after it.
    rocking: Cell<bool>,
}

impl<R> Log<R> for &LastTrial {
    fn switched(&mut self, kind: u32, _: R, state: &State<R>) {
        self.switch.set(kind);
        self.rocking.set(state.mode != FULL_CONTACT);
    }
}

/// The trials of a cell to its end; none of one that is done before it begins.
fn trials<R: Real>(shared: Shared<'_, R>, job: Job<R>) -> Vec<Packed> {
    let mut trials = Vec::new();
    let (mut searching, mut ended) = (false, job.state.status != RUNNING);
    let rocks = job.state.mode != FULL_CONTACT;
    let last = LastTrial { switch: Cell::new(NOTHING), rocking: Cell::new(rocks) };
    let mut log = &last;
    let mut lanes = Lanes::new(shared, R::of(0.0));
    lanes.log = Some(&mut log);
    lanes.load(0, job);
    while !ended {
        let (fresh, rocking) = (R::any(lanes.between_steps()), last.rocking.get());
        last.switch.set(NOTHING);
        let before = lanes.time(0);
        ended = lanes.advance() != 0;
        let at_edge = R::any(lanes.between_steps());
        let purpose = match (lanes.time(0) != before, last.switch.get()) {
            (_, UPLIFT_LEFT | UPLIFT_RIGHT) => Purpose::Uplift,
            (false, _) if searching => Purpose::Try,
            (false, _) => Purpose::GivenUp,
            (true, _) if searching => Purpose::Arrival,
            (true, IMPACT) => Purpose::Landing,
            (true, _) if fresh && at_edge => Purpose::Step,
            (true, _) => Purpose::Part,
        };
        searching = matches!(purpose, Purpose::GivenUp | Purpose::Try);
        trials.push(Packed::of(Trial { purpose, rocking, at_edge }));
    }
    trials
}

/// Sweeps a grid cell by cell: their trials.
pub fn record<R: Real>(plan: &Plan, grid: &Grid) -> Traces {
    let record = plan.record::<R>();
    let cells: Vec<usize> = (0..grid.len()).collect();
    let all = Cells::<R>::of(plan, grid, &cells, &record, &Unwatched);
    let shared = Shared { variant: plan.variant(), models: all.bodies(), record: &record };
    let of_cell = |&number: &usize| {
        let (cell, state) = all.begin(number);
        trials(shared, Job { number, cell, state })
    };
    let ran: Vec<_> = cells.par_iter().map(of_cell).collect();
    let mut traces = Traces::default();
    ran.iter().for_each(|trials| traces.add(trials));
    traces
}
