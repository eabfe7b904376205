//! The outcomes of cells from the last states that a device has written.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use super::BackendError;
use super::tile::OwnClocks;
use crate::backend::sink::Sink;
use crate::cells::ready::Cells;
use crate::model::real::Real;
use crate::stepping::log::Event;
use crate::stepping::outcome::Outcome;
use crate::stepping::state::{PROVED, RUNNING, State};

/// What is known of the cells that a device computed, but for their outcomes.
pub struct DeviceRun<R> {
    /// The number of cells whose outcomes were handed over: the first ones of the list.
    pub done: usize,
    /// The first switches of each cell, the requested number for each.
    pub events: Vec<Event<R>>,
    /// The time in the shader by the clock of the device; none where the device has no clock.
    pub device: Option<Duration>,
}

/// Hands over the outcomes of the cells of a tile, by their numbers in the list, on all cores. `bytes` are the states
/// of the cells.
///
/// # Errors
/// [`BackendError::Unfinished`] where a cell still runs or has no status at all: it was never computed. Such a cell is
/// not handed over.
pub fn read<R: Real>(
    all: &Cells<R>,
    tile: Range<usize>,
    own: Option<&OwnClocks<R>>,
    bytes: &[u8],
    sink: Sink,
) -> Result<(), BackendError> {
    let cells = all.tables.cells().part(tile.clone());
    let bytes = &bytes[..(cells.len() * size_of::<State<R>>()).min(bytes.len())];
    let copy: Vec<State<R>>;
    let states: &[State<R>] = match bytemuck::try_cast_slice(bytes) {
        Ok(states) => states,
        // Some drivers map memory at an unaligned address.
        Err(_) => {
            copy = bytemuck::pod_collect_to_vec(bytes);
            &copy
        }
    };
    if states.len() != cells.len() {
        return Err(BackendError::Unfinished(cells.len() - states.len()));
    }
    let unfinished = AtomicUsize::new(0);
    let grid = all.tables.grid();
    let columns = grid.shape().0;
    let of = |some: Range<usize>, outcomes: &mut Vec<Outcome>| {
        let ended = |state: &State<R>| (RUNNING + 1..=PROVED).contains(&state.status);
        match states[some.clone()].iter().filter(|state| !ended(state)).count() {
            0 => {}
            running => {
                unfinished.fetch_add(running, Ordering::Relaxed);
                return;
            }
        }
        let mut cell = all.tables.cell(tile.start + some.start);
        for at in some.clone() {
            let state = &states[at];
            // Most cells follow the cell before them in its row, and their places need no division.
            if at > some.start {
                cell.number += 1;
                if cells.at(at) == cells.at(at - 1) + 1 && cell.place[0] + 1 < columns {
                    cell.place[0] += 1;
                } else {
                    cell.place = grid.place(cells.at(at));
                }
            }
            outcomes.push(match own {
                Some(own) => all.outcome_at(&cell, &own.clocks[own.numbers[at] as usize], state),
                None => all.outcome_at(&cell, &all.tables.clock(&cell), state),
            });
        }
    };
    sink.fill(tile.clone(), of);
    match unfinished.into_inner() {
        0 => Ok(()),
        some => Err(BackendError::Unfinished(some)),
    }
}
