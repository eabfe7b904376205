//! What a tile of cells has on the device.

use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages,
    ComputePipeline, QuerySet, QuerySetDescriptor, QueryType,
};

use super::device::Gpu;
use crate::integrate::log::Event;
use crate::integrate::state::State;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::real::Real;

/// The buffers of a tile, and how the shader is given them.
pub struct Tile {
    /// The cells' states.
    pub states: Buffer,
    /// How much a chunk is to do.
    pub chunk: Buffer,
    /// What a chunk did.
    pub progress: Buffer,
    /// The same, and the clock's ticks, where the host can read them.
    pub back: Buffer,
    /// The cells' first switches, where they are kept.
    pub events: Option<Buffer>,
    /// The device's clock, where it has one.
    pub clock: Option<Clock>,
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
        let progress = empty(gpu, "progress", 8, both_ways);
        let event_bytes = (cells.len() * events_kept * size_of::<Event<R>>()) as u64;
        let events = (events_kept > 0).then(|| empty(gpu, "events", event_bytes, both_ways));
        let clock = gpu.has_clock().then(|| Clock {
            queries: gpu.device.create_query_set(&QuerySetDescriptor {
                label: Some("clock"),
                ty: QueryType::Timestamp,
                count: 2,
            }),
            ticks: empty(gpu, "ticks", 16, BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
        });
        let back = empty(gpu, "back", 24, BufferUsages::COPY_DST | BufferUsages::MAP_READ);
        let bound = [&model, &cells_buffer, &states_buffer, &chunk, &progress, record];
        let entries: Vec<BindGroupEntry> = bound
            .into_iter()
            .chain(&events)
            .zip(0..)
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
        Tile { states: states_buffer, chunk, progress, back, events, clock, bind_group }
    }
}
