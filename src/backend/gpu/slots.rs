//! Places for the cells of two tiles on the device, used again by tile after tile and by sweep after
//! sweep.

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

/// Tiles on the device at once: while one has its last long cells to run, the next is begun.
pub const SIDES: usize = 2;
/// Submissions on the way at once: while the host looks at one, the device runs the next.
pub const FLIGHTS: usize = 2;
/// Dispatches in the ring of tallies.
pub const RING: usize = 4;
/// Bytes of a tally.
pub const TALLY: u64 = 32;
/// From one dispatch's uniform numbers to the next one's: what every device allows.
pub const DISPATCH_STRIDE: u64 = 256;

/// Buffers for two tiles of cells.
pub struct Slots {
    /// Cells of a tile at most.
    pub tile: usize,
    /// Bytes of a cell's state.
    pub state_size: u64,
    /// Bytes of a cell's first switches.
    pub events_size: u64,
    /// The cells' numbers.
    pub cells: Buffer,
    /// Their states.
    pub states: Buffer,
    /// How much a dispatch is to do, by its place in the ring.
    pub dispatch: Buffer,
    /// What dispatches did.
    pub tally: Buffer,
    /// The two lists of running cells.
    pub running: Buffer,
    /// The cells' first switches, where they are kept.
    pub events: Option<Buffer>,
    /// What each tile has of its own.
    pub sides: [Side; SIDES],
    /// What each submission on the way has of its own.
    pub flights: [Flight; FLIGHTS],
    /// Motions in full contact that are on the device, and whose they are.
    pub motions: Option<(Arc<dyn Any + Send + Sync>, Buffer)>,
    /// How fast the device was.
    pub pace: Pace,
}

/// What a tile has of its own.
pub struct Side {
    /// See [`Tile`](super::tile::Tile).
    pub tile: Buffer,
    /// Numbers of clocks, and places of motions.
    pub words: Buffer,
    /// The clocks of its cells.
    pub clocks: Buffer,
    /// Its last states, where the host can read them.
    pub states_back: Buffer,
    /// Its switches, where the host can read them.
    pub events_back: Option<Buffer>,
}

/// What a submission on the way has of its own.
pub struct Flight {
    /// The tally and the clock's ticks, where the host can read them.
    pub back: Buffer,
    /// The ticks at its two ends, where the device has a clock.
    pub clock: Option<(QuerySet, Buffer)>,
}

/// A buffer of a given number of bytes, four at least.
pub fn buffer(gpu: &OpenDevice, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    gpu.device.create_buffer(&BufferDescriptor {
        label: Some(label),
        // Whole 16 bytes, as a uniform buffer's size is on some devices.
        size: size.max(1).next_multiple_of(16),
        usage,
        mapped_at_creation: false,
    })
}

/// Writes the contents of a buffer; makes it anew, with room to spare, where it is too small.
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
    /// Slots for two tiles of a given number of cells, with place for `events_kept` switches of each.
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

    /// True where they do for tiles of a given number of cells.
    pub fn suit<R: Real>(&self, tile: usize, events_kept: usize) -> bool {
        self.tile >= tile
            && self.state_size == size_of::<State<R>>() as u64
            && self.events_size == (events_kept * size_of::<Event<R>>()) as u64
    }
}
