//! A cell at the start of its integration: its numbers and its first state. Twin of `shaders/begin.wgsl`.

use super::at_rest::at_rest;
use super::cell_tables::CellTables;
use super::contact::motions::MotionPair;
use super::contact::shared_contact::full_contact;
use super::listing::CellAt;
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::stepping::state::{RUNNING, State};

/// A cell of a list and its first state; `motions` are the motions that the cell shares with others, if it does.
#[inline(always)]
pub fn begin<R: Real>(
    tables: &CellTables<R>,
    motions: Option<MotionPair<R>>,
    cell: &CellAt,
) -> (Cell<R>, State<R>) {
    let cell = tables.numbers(cell);
    let mut state = at_rest(cell.finite(), cell.drive.tilt);
    if let Some(motions) = motions
        && state.status == RUNNING
    {
        let model = &tables.bodies.entries[cell.body as usize];
        full_contact(&motions, model, &cell, &mut state);
    }
    (cell, state)
}
