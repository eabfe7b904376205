//! One cell by itself, on vectors of one lane.

use crate::model::CellEquations;
use crate::model::excitation::Cell;
use crate::model::real::Real;

use super::lanes::{Job, Lanes, Shared};
use super::log::Log;
use super::state::{RUNNING, State};

/// The integration of one cell.
pub struct Single<'a, R: Real> {
    lanes: Lanes<'a, R>,
}

impl<'a, R: Real> Single<'a, R> {
    /// A cell at a state; `log` is told of its switches.
    pub fn new(
        set: &CellEquations<'a, R>,
        state: &State<R>,
        log: &'a mut dyn Log<R>,
    ) -> Single<'a, R> {
        let models = std::slice::from_ref(set.model);
        let shared = Shared { variant: set.variant, models, record: set.record };
        let mut lanes = Lanes::new(shared, R::of(0.0));
        lanes.log = Some(log);
        if state.status == RUNNING {
            // There is only one body.
            let cell = Cell { body: 0, ..*set.cell };
            lanes.load(0, Job { number: 0, cell, state: *state });
        } else {
            lanes.lanes[0].job.state = *state;
        }
        Single { lanes }
    }

    /// One turn; false where the cell has ended.
    fn turn(&mut self) -> bool {
        if self.lanes.running != 0 && self.lanes.advance() != 0 {
            self.lanes.store(0);
            self.lanes.running = 0;
        }
        self.lanes.running != 0
    }

    /// Takes the cell over the rest of its step, or to the start of the step at a boundary; false where the cell has
    /// ended.
    pub fn step(&mut self) -> bool {
        if self.lanes.running == 0 {
            return false;
        }
        let step = self.lanes.step(0);
        while self.turn() {
            if self.lanes.step(0) != step {
                return true;
            }
        }
        false
    }

    /// The present state.
    pub fn state(&mut self) -> State<R> {
        if self.lanes.running != 0 {
            self.lanes.store(0);
        }
        self.lanes.lanes[0].job.state
    }

    /// Integrates the cell to its end.
    pub fn finish(mut self) -> State<R> {
        while self.turn() {}
        self.state()
    }
}

/// Integrates a cell from a state to its end.
pub fn run<'a, R: Real>(
    set: &CellEquations<'a, R>,
    state: &State<R>,
    log: &'a mut dyn Log<R>,
) -> State<R> {
    Single::new(set, state, log).finish()
}
