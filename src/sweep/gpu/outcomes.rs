//! The outcomes of cells from the last states that a device has written.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use rayon::prelude::*;

use super::super::cells::Cells;
use super::BackendError;
use super::tile::OwnClocks;
use crate::model::real::Real;
use crate::stepping::log::Event;
use crate::stepping::outcome::Outcome;
use crate::stepping::state::{PROVED, RUNNING, State};
use crate::sweep::threads::on;

/// Cells that a thread reads at once.
const CHUNK: usize = 1 << 12;

/// The outcomes of cells that a device computed, and the time that it took.
pub struct DeviceOutcomes<R> {
    /// One a cell, in their order.
    pub outcomes: Vec<Outcome>,
    /// The first switches of each cell, as many for each as were asked for.
    pub events: Vec<Event<R>>,
    /// Time in the shader, by the device's clock; none on a device that has no such clock.
    pub device: Option<Duration>,
}

/// Adds the outcomes of a tile's cells, by all cores, to those of the tiles before it. `bytes` are
/// the cells' states.
///
/// # Errors
/// [`BackendError::Unfinished`] where a cell still runs or has no status at all: it was never computed.
pub fn read<R: Real>(
    all: &Cells<R>,
    cells: &[usize],
    own: Option<&OwnClocks<R>>,
    bytes: &[u8],
    outcomes: &mut Vec<Outcome>,
) -> Result<(), BackendError> {
    let bytes = &bytes[..(cells.len() * size_of::<State<R>>()).min(bytes.len())];
    let copy: Vec<State<R>>;
    let states: &[State<R>] = match bytemuck::try_cast_slice(bytes) {
        Ok(states) => states,
        // Where a driver maps memory at an odd address.
        Err(_) => {
            copy = bytemuck::pod_collect_to_vec(bytes);
            &copy
        }
    };
    if states.len() != cells.len() {
        return Err(BackendError::Unfinished(cells.len() - states.len()));
    }
    let unfinished = AtomicUsize::new(0);
    let of = |(at, (state, &cell)): (usize, (&State<R>, &usize))| {
        if state.status == RUNNING || state.status > PROVED {
            unfinished.fetch_add(1, Ordering::Relaxed);
        }
        match own {
            Some(own) => all.outcome_by(&own.clocks[own.numbers[at] as usize], cell, state),
            None => all.outcome(cell, state),
        }
    };
    let all = states.par_iter().zip(cells).enumerate().map(of).with_min_len(CHUNK);
    on(|| outcomes.par_extend(all));
    match unfinished.into_inner() {
        0 => Ok(()),
        some => Err(BackendError::Unfinished(some)),
    }
}
