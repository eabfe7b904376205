//! The cells of a grid: a cell's numbers and first state from the tables, and its outcome from its last
//! state.

use std::sync::Arc;

use super::begin::begin;
use super::cell_tables::CellTables;
use super::clock::Clock;
use super::full_contact::FullContactMotions;
use super::plan::Plan;
use super::progress::Progress;
use super::reader::Reader;
use super::table::Window;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::{Case, Grid};
use crate::stepping::outcome::Outcome;
use crate::stepping::state::State;

/// The data from which some cells of a plan's grid are made.
pub struct Cells<'a, R> {
    /// Their numbers.
    pub tables: CellTables<'a, R>,
    /// Their shared motions in full contact, where they share them.
    pub motions: Arc<Option<FullContactMotions<R>>>,
}

impl<'a, R: Real> Cells<'a, R> {
    /// Some cells of a plan's grid under its record; `progress` may end the preparation, and then the sweep.
    pub fn of(
        plan: &'a Plan,
        grid: &'a Grid,
        cells: &[usize],
        record: &[Ground<R>],
        progress: &dyn Progress,
    ) -> Cells<'a, R> {
        let window = Window::around(grid, cells);
        Cells {
            tables: CellTables::of(plan, grid, &window),
            motions: plan.full_contact_motions(grid, record, progress),
        }
    }

    /// The bodies, by number.
    pub fn bodies(&self) -> &[Model<R>] {
        &self.tables.bodies.entries
    }

    /// A cell as its integration begins. Not inlined, so that it is compiled once, not for every kind of
    /// vector.
    #[inline(never)]
    pub fn begin(&self, index: usize) -> (Cell<R>, State<R>) {
        let motions = self.motions.as_ref().as_ref();
        begin(&self.tables, motions, &self.tables.place(index))
    }

    /// The outcome of a cell whose last state is `state`.
    #[inline(never)]
    pub fn outcome(&self, index: usize, state: &State<R>) -> Outcome {
        let place = self.tables.place(index);
        self.outcome_at(&place, &self.tables.clock(&place), state)
    }

    /// The same of a cell at a place, of this clock.
    #[inline]
    pub fn outcome_at(&self, place: &Place, clock: &Clock, state: &State<R>) -> Outcome {
        self.tables.readers.at(place).outcome(clock, state)
    }
}

impl Plan {
    /// The outcome of a cell whose last state is `state`.
    pub fn outcome<R: Real>(&self, case: &Case, state: &State<R>) -> Outcome {
        Reader::of(case).outcome(&self.clock(case), state)
    }
}
