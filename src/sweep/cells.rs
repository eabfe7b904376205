//! The cells of a grid: from the tables to the state that each begins in, and from the state that it
//! ends in to its outcome.

use std::sync::Arc;

use super::begin::begin;
use super::cell_tables::CellTables;
use super::clock::Clock;
use super::full_contact::FullContactMotions;
use super::plan::Plan;
use super::reader::Reader;
use super::table::Window;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::real::Real;
use crate::scene::{Case, Grid};
use crate::stepping::outcome::Outcome;
use crate::stepping::state::State;

/// All that some cells of a plan's grid are made of.
pub struct Cells<'a, R> {
    /// Their numbers.
    pub tables: CellTables<'a, R>,
    /// The full contact that they share, if they do.
    pub motions: Arc<Option<FullContactMotions<R>>>,
}

impl<'a, R: Real> Cells<'a, R> {
    /// Some cells of a plan's grid under its record.
    pub fn of(
        plan: &'a Plan,
        grid: &'a Grid,
        cells: &[usize],
        record: &[Ground<R>],
    ) -> Cells<'a, R> {
        let window = Window::around(grid, cells);
        Cells {
            tables: CellTables::of(plan, grid, &window),
            motions: plan.full_contact_motions(grid, record),
        }
    }

    /// The bodies, by the cells' numbers of them.
    pub fn bodies(&self) -> &[Model<R>] {
        &self.tables.bodies.entries
    }

    /// A cell as its integration begins. Compiled once, not for every kind of vector.
    #[inline(never)]
    pub fn begin(&self, index: usize) -> (Cell<R>, State<R>) {
        let motions = self.motions.as_ref().as_ref();
        begin(&self.tables, motions, &self.tables.place(index))
    }

    /// What became of a cell whose run has ended in `state`.
    #[inline(never)]
    pub fn outcome(&self, index: usize, state: &State<R>) -> Outcome {
        let place = self.tables.place(index);
        self.tables.readers.at(&place).outcome(&self.tables.clock(&place), state)
    }

    /// The same of a cell of this clock.
    #[inline]
    pub fn outcome_by(&self, clock: &Clock, index: usize, state: &State<R>) -> Outcome {
        self.tables.readers.at(&self.tables.place(index)).outcome(clock, state)
    }
}

impl Plan {
    /// What became of a cell whose run has ended in `state`.
    pub fn outcome<R: Real>(&self, case: &Case, state: &State<R>) -> Outcome {
        Reader::of(case).outcome(&self.clock(case), state)
    }
}
