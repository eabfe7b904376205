//! What a tile of cells has on the device.

use std::array::from_fn;

use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages,
    ComputePipeline, QuerySet, QuerySetDescriptor, QueryType,
};

use super::device::Gpu;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::real::Real;
use crate::stepping::log::Event;
use crate::stepping::state::{RUNNING, State};

/// Chunks that are on the way at once: while the host looks at one, the device runs the next.
pub const FLIGHTS: usize = 2;
/// Tallies in the ring.
pub const TALLIES: u64 = 4;
/// Bytes of a tally.
pub const TALLY: u64 = 8;

/// The buffers of a tile, and how the shader is given them.
pub struct Tile {
    /// Cells in it.
    pub cells: usize,
    /// The cells' states.
    pub states: Buffer,
    /// How much a chunk is to do.
    pub chunk: Buffer,
    /// What chunks did.
    pub tallies: Buffer,
    /// A tally, and the clock's ticks, where the host can read them.
    pub back: [Buffer; FLIGHTS],
    /// The cells' first switches, where they are kept.
    pub events: Option<Buffer>,
    /// The device's clocks, where it has them.
    pub clocks: Option<[Clock; FLIGHTS]>,
    /// All of a shader's buffers.
    pub bind_group: BindGroup,
}

/// The ticks at a pass's two ends.
pub struct Clock {
    /// The two queries.
    pub queries: QuerySet,
    /// Their results.
    pub ticks: Buffer,
}

fn filled(gpu: &Gpu, label: &str, contents: &[u8], usage: BufferUsages) -> Buffer {
    let label = Some(label);
    gpu.device.create_buffer_init(&BufferInitDescriptor { label, contents, usage })
}

fn empty(gpu: &Gpu, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    let descriptor =
        BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
    gpu.device.create_buffer(&descriptor)
}

impl Tile {
    /// The record's samples, the same for every tile.
    pub fn record<R: Real>(gpu: &Gpu, samples: &[Ground<R>]) -> Buffer {
        filled(gpu, "record", bytemuck::cast_slice(samples), BufferUsages::STORAGE)
    }

    /// Puts cells on the device, with place for `events_kept` switches of each.
    pub fn new<R: Real>(
        gpu: &Gpu,
        pipeline: &ComputePipeline,
        model: &Model<R>,
        cells: &[Cell<R>],
        states: &[State<R>],
        record: &Buffer,
        events_kept: usize,
    ) -> Tile {
        let storage = BufferUsages::STORAGE;
        let both_ways = storage | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let model = filled(gpu, "model", bytemuck::bytes_of(model), storage);
        let cells_buffer = filled(gpu, "cells", bytemuck::cast_slice(cells), storage);
        let states_buffer = filled(gpu, "states", bytemuck::cast_slice(states), both_ways);
        let chunk = empty(gpu, "chunk", 16, BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        // Of what still runs the first list, and place for the second.
        let running = |state: &State<R>| state.status == RUNNING;
        let mut lists: Vec<u32> = states
            .iter()
            .zip(0_u32..)
            .filter_map(|(state, lane)| running(state).then_some(lane))
            .collect();
        let mut tallies = [0_u32; (TALLIES * TALLY / 4) as usize];
        // A tile has fewer than 2^32 cells.
        tallies[0] = lists.len() as u32;
        lists.resize(2 * cells.len(), 0);
        let tallies = filled(gpu, "tallies", bytemuck::cast_slice(&tallies), both_ways);
        let lists = filled(gpu, "running", bytemuck::cast_slice(&lists), storage);
        let event_bytes = (cells.len() * events_kept * size_of::<Event<R>>()) as u64;
        let events = (events_kept > 0).then(|| empty(gpu, "events", event_bytes, both_ways));
        let clock = |_| Clock {
            queries: gpu.device.create_query_set(&QuerySetDescriptor {
                label: Some("clock"),
                ty: QueryType::Timestamp,
                count: 2,
            }),
            ticks: empty(gpu, "ticks", 16, BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
        };
        let clocks = gpu.has_clock().then(|| from_fn(clock));
        let read = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
        let back = from_fn(|_| empty(gpu, "back", TALLY + 16, read));
        let bound = [&model, &cells_buffer, &states_buffer, &chunk, &tallies, record];
        let entries: Vec<BindGroupEntry> = bound
            .into_iter()
            .zip(0..)
            .chain(events.iter().map(|events| (events, 6)))
            .chain([(&lists, 7)])
            .map(|(buffer, binding)| BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let bind_group = gpu.device.create_bind_group(&BindGroupDescriptor {
            label: Some("sweep"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let (cells, states) = (cells.len(), states_buffer);
        Tile { cells, states, chunk, tallies, back, events, clocks, bind_group }
    }
}
