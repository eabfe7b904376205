//! A cell as its integration begins: its numbers and its first state. Twin of `shaders/begin.wgsl`.

use super::at_rest::at_rest;
use super::cell_tables::CellTables;
use super::full_contact::FullContactMotions;
use super::shared_contact::full_contact;
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::stepping::state::{RUNNING, State};

/// A cell of a grid and its first state.
#[inline(always)]
pub fn begin<R: Real>(
    tables: &CellTables<R>,
    motions: Option<&FullContactMotions<R>>,
    place: &Place,
) -> (Cell<R>, State<R>) {
    let groups = tables.groups(place);
    let cell = groups.cell();
    let mut state = at_rest(groups.sound(), groups.drive.tilt);
    if let Some(motions) = motions
        && state.status == RUNNING
    {
        let model = &tables.bodies.entries[cell.body as usize];
        full_contact(motions, model, place, groups.drive.scale, &cell, &mut state);
    }
    (cell, state)
}
