//! The cells of a list: a cell's numbers and first state from the tables, and its outcome from its last
//! state.

use std::sync::Arc;

use super::begin::begin;
use super::cell_list::CellList;
use super::cell_tables::CellTables;
use super::clock::Clock;
use super::contact::full_contact::FullContactMotions;
use super::contact::motions::MotionPair;
use super::contact::shared::shared_motions;
use super::listing::{CellAt, Index};
use super::plan::Plan;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::real::Real;
use crate::scene::Grid;
use crate::stepping::long_step::LongSteps;
use crate::stepping::outcome::Outcome;
use crate::stepping::state::State;
use crate::work::observer::Observer;

/// The data from which some cells of a plan's grid are made.
pub struct Cells<'a, R> {
    /// The tables of their numbers.
    pub tables: CellTables<'a, R>,
    /// Their shared motions in full contact, if they share any.
    pub motions: Arc<Option<FullContactMotions<R>>>,
    /// Where they find their motions of u and of v.
    pub of_motions: Option<[Index; 2]>,
    /// The record.
    record: &'a [Ground<R>],
}

impl<'a, R: Real> Cells<'a, R> {
    /// Some cells of a plan's grid under its record; `observer` may end the preparation, and then the sweep.
    pub fn of(
        plan: &'a Plan,
        grid: &'a Grid,
        cells: impl Into<CellList<'a>>,
        record: &'a [Ground<R>],
        observer: &dyn Observer,
    ) -> Cells<'a, R> {
        let cells = cells.into();
        let tables = CellTables::of(plan, grid, cells);
        let motions = shared_motions(plan, (grid, cells), record, observer);
        let of_motions = motions.as_ref().as_ref().map(|motions| motions.index(grid, cells));
        Cells { tables, motions, of_motions, record }
    }

    /// The bodies, by number.
    pub fn bodies(&self) -> &[Model<R>] {
        &self.tables.bodies.entries
    }

    /// A cell, by its number in the list, at the start of its integration. The function is not inlined, so that it is
    /// compiled once and not for every kind of vector.
    #[inline(never)]
    pub fn begin(&self, number: usize) -> (Cell<R>, State<R>) {
        let cell = self.tables.cell(number);
        begin(&self.tables, self.motions_of(&cell), &cell)
    }

    /// The long steps of a cell under a record, by its number in the list.
    #[inline(never)]
    pub fn long_steps(&self, number: usize) -> LongSteps<R> {
        let cell = self.tables.cell(number);
        let (clock, vertical) = (self.tables.clock(&cell), self.tables.vertical.at(&cell));
        let base = [vertical.stiffness_v, vertical.damping_v].map(R::to_f64);
        LongSteps::of(clock.step_forced, [clock.substeps, clock.substeps_h], base)
    }

    /// The motions that a cell shares, if it does.
    #[inline(always)]
    pub(crate) fn motions_of(&self, cell: &CellAt) -> Option<MotionPair<'_, R>> {
        let motions = self.motions.as_ref().as_ref()?;
        let pair = |of: &[Index; 2]| motions.pair([of[0].of(cell), of[1].of(cell)], self.record);
        self.of_motions.as_ref().map(pair)
    }

    /// The outcome of a cell whose last state is `state`.
    #[inline(never)]
    pub fn outcome(&self, number: usize, state: &State<R>) -> Outcome {
        let cell = self.tables.cell(number);
        self.outcome_at(&cell, &self.tables.clock(&cell), state)
    }

    /// The same for a cell with this clock.
    #[inline]
    pub fn outcome_at(&self, cell: &CellAt, clock: &Clock, state: &State<R>) -> Outcome {
        self.tables.readers.at(cell).outcome(clock, state)
    }
}
