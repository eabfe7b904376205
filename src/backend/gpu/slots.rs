//! The buffers for the cells of some tiles on the device, used again by each tile and each sweep.

use std::any::Any;
use std::array::from_fn;
use std::sync::Arc;

use wgpu::{Buffer, BufferDescriptor, BufferUsages, QuerySet, QuerySetDescriptor, QueryType};

use super::device::OpenDevice;
use super::pace::Pace;
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::stepping::log::Event;
use crate::stepping::state::State;

/// The number of tiles on the device at once: while some still have their last long cells to run, the next is begun.
pub const SIDES: usize = 4;
/// The number of submissions that are not finished: while the host reads one, the device runs the next.
pub const FLIGHTS: usize = 2;
/// The number of dispatches in the ring of tallies.
pub const RING: usize = 4;
/// The number of words in a tally: the cells to run by dispatch, those left by side, the steps, and padding.
pub const TALLY_WORDS: usize = RING + SIDES + 4;
/// The size of a tally, bytes.
pub const TALLY: u64 = 4 * TALLY_WORDS as u64;
/// The distance between the uniform numbers of two dispatches, bytes: every device allows it.
pub const DISPATCH_STRIDE: u64 = 256;

/// Buffers for the tiles of a sweep that are on the device at once.
pub struct Slots {
    /// The most cells of a tile.
    pub tile: usize,
    /// The size of the state of a cell, bytes.
    pub state_size: u64,
    /// The size of the first switches of a cell, bytes.
    pub events_size: u64,
    /// The numbers of the cells.
    pub cells: Buffer,
    /// The states of the cells.
    pub states: Buffer,
    /// The amount of work of a dispatch, by its place in the ring.
    pub dispatch: Buffer,
    /// The tallies of dispatches.
    pub tally: Buffer,
    /// The two lists of running cells.
    pub running: Buffer,
    /// The first switches of the cells, where they are kept.
    pub events: Option<Buffer>,
    /// The buffers of each tile.
    pub sides: [Side; SIDES],
    /// The buffers of each submission that is not finished.
    pub flights: [Flight; FLIGHTS],
    /// Motions in full contact that are on the device, and the object to which they belong.
    pub motions: Option<(Arc<dyn Any + Send + Sync>, Buffer)>,
    /// The speed of the device so far.
    pub pace: Pace,
}

/// The buffers of one tile.
pub struct Side {
    /// See [`Tile`](super::tile::Tile).
    pub tile: Buffer,
    /// Numbers of clocks, and places of motions.
    pub words: Buffer,
    /// The clocks of its cells.
    pub clocks: Buffer,
    /// The last states, where the host can read them.
    pub states_back: Buffer,
    /// The switches, where the host can read them.
    pub events_back: Option<Buffer>,
}

/// The buffers of a submission that is not finished.
pub struct Flight {
    /// The tally and the clock's ticks, where the host can read them.
    pub back: Buffer,
    /// The ticks at its begin and at its end, where the device has a clock.
    pub clock: Option<(QuerySet, Buffer)>,
}

/// A buffer of at least a given number of bytes.
pub fn buffer(gpu: &OpenDevice, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    gpu.device.create_buffer(&BufferDescriptor {
        label: Some(label),
        // Some devices require a multiple of 16 bytes for a uniform buffer.
        size: size.max(1).next_multiple_of(16),
        usage,
        mapped_at_creation: false,
    })
}

/// Writes the contents of a buffer; where the buffer is too small, makes a new one with room to spare.
pub fn refill(gpu: &OpenDevice, place: &mut Buffer, contents: &[u8]) {
    let size = contents.len() as u64;
    if place.size() < size {
        *place = buffer(gpu, "refilled", size.next_power_of_two(), place.usage());
    }
    gpu.queue.write_buffer(place, 0, contents);
}

const STORAGE: BufferUsages = BufferUsages::STORAGE.union(BufferUsages::COPY_DST);
const BOTH_WAYS: BufferUsages = STORAGE.union(BufferUsages::COPY_SRC);
const UNIFORM: BufferUsages = BufferUsages::UNIFORM.union(BufferUsages::COPY_DST);
const BACK: BufferUsages = BufferUsages::MAP_READ.union(BufferUsages::COPY_DST);

impl Slots {
    /// Buffers for tiles of a given number of cells, with room for `events_kept` switches of each cell.
    pub fn new<R: Real>(gpu: &OpenDevice, tile: usize, events_kept: usize) -> Slots {
        let slots = (SIDES * tile) as u64;
        let state_size = size_of::<State<R>>() as u64;
        let events_size = (events_kept * size_of::<Event<R>>()) as u64;
        let cell_size = size_of::<Cell<R>>() as u64;
        let kept = |size: u64, usage| {
            (events_kept > 0).then(|| buffer(gpu, "events", size * events_size, usage))
        };
        let side = |_| Side {
            tile: buffer(gpu, "tile", 0, UNIFORM),
            words: buffer(gpu, "words", 0, STORAGE),
            clocks: buffer(gpu, "clocks", 0, STORAGE),
            states_back: buffer(gpu, "states back", tile as u64 * state_size, BACK),
            events_back: kept(tile as u64, BACK),
        };
        let clock = || {
            let queries = gpu.device.create_query_set(&QuerySetDescriptor {
                label: Some("clock"),
                ty: QueryType::Timestamp,
                count: 2,
            });
            let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
            (queries, buffer(gpu, "ticks", 16, usage))
        };
        let flight = |_| Flight {
            back: buffer(gpu, "back", TALLY + 16, BACK),
            clock: gpu.has_clock().then(clock),
        };
        Slots {
            tile,
            state_size,
            events_size,
            cells: buffer(gpu, "cells", slots * cell_size, BOTH_WAYS),
            states: buffer(gpu, "states", slots * state_size, BOTH_WAYS),
            dispatch: buffer(gpu, "dispatch", RING as u64 * DISPATCH_STRIDE, UNIFORM),
            tally: buffer(gpu, "tally", TALLY, BOTH_WAYS),
            running: buffer(gpu, "running", 2 * 4 * slots, BOTH_WAYS),
            events: kept(slots, BOTH_WAYS),
            sides: from_fn(side),
            flights: from_fn(flight),
            motions: None,
            pace: Pace::default(),
        }
    }

    /// True where the buffers are suitable for tiles of a given number of cells.
    pub fn suit<R: Real>(&self, tile: usize, events_kept: usize) -> bool {
        self.tile >= tile
            && self.state_size == size_of::<State<R>>() as u64
            && self.events_size == (events_kept * size_of::<Event<R>>()) as u64
    }
}
