//! The data on the device from which the cells of a sweep are made.

use std::any::Any;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, Buffer, BufferBinding,
    BufferSize, BufferUsages, ComputePipeline,
};

use super::device::OpenDevice;
use super::listed::{self, Firsts};
use super::pipelines::Pipelines;
use super::slots::{DISPATCH_STRIDE, RING, Slots, refill};
use super::tile::{Layout, OwnClocks, Tile};
use crate::cells::cell_tables::Clocks;
use crate::cells::contact::full_contact::FullContactMotions;
use crate::cells::ready::Cells;
use crate::model::excitation::{Ground, Steps};
use crate::model::real::Real;
use crate::scene::grid::AXES;

/// The most gaps between samples that a thread searches, twice at most: the software driver ends loops silently after
/// 65,535 iterations.
const MOST_GAPS: usize = 30_000;

/// The data that all tiles of a sweep share.
pub struct Inputs<R> {
    model: Buffer,
    numbers: Buffer,
    motions: Buffer,
    /// The description of a tile whose cells find their numbers by their places.
    tile: Tile,
    /// True where the cells find all their numbers by their places.
    by_place: bool,
    /// The beginning of each table.
    firsts: Firsts,
    /// The beginnings of the motions.
    words: Vec<u32>,
    /// The clocks, if the tables hold them.
    steps: Vec<Steps<R>>,
    /// The buffers of a dispatch, by its place in the ring.
    pub dispatches: [BindGroup; RING],
}

/// A buffer with these contents; it has one number at least.
fn filled<R: Real>(gpu: &OpenDevice, label: &str, contents: &[u8], usage: BufferUsages) -> Buffer {
    let nothing = [R::of(0.0)];
    let contents = if contents.is_empty() { bytemuck::cast_slice(&nothing) } else { contents };
    gpu.device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
}

impl<R: Real> Inputs<R> {
    /// Writes the data that the cells of a plan share to the device.
    pub fn new(
        gpu: &OpenDevice,
        pipelines: &Pipelines,
        slots: &mut Slots,
        cells: &Cells<R>,
        record: &[Ground<R>],
    ) -> Inputs<R> {
        let tables = &cells.tables;
        // The record stands before the tables, because a kernel has no more than eight storage buffers.
        let mut numbers: Vec<R> = bytemuck::cast_slice(record).to_vec();
        let mut firsts: Firsts = [0; AXES];
        for (first, table) in firsts.iter_mut().zip([
            bytemuck::cast_slice(&tables.horizontal.entries),
            bytemuck::cast_slice(&tables.vertical.entries),
            bytemuck::cast_slice(&tables.drive.entries),
        ]) {
            *first = numbers.len();
            numbers.extend_from_slice(table);
        }
        let mut tile = Tile { counts: tables.grid().counts(), ..Tile::default() };
        // The kernel that makes cells reads only these numbers of a body.
        tile.levers = numbers.len() as u32;
        for body in &tables.bodies.entries {
            numbers.extend([body.height, body.left.arm, body.right.arm]);
        }
        let steps = match &tables.clocks {
            Clocks::Shared(shared) => shared.entries.iter().map(|(_, steps)| *steps).collect(),
            Clocks::Own(_) => Vec::new(),
        };
        let mut words = Vec::new();
        let limit = gpu.device.limits().max_storage_buffer_binding_size;
        let shared = cells.motions.as_ref().as_ref().filter(|motions| fits(motions, limit));
        if let Some(shared) = shared {
            tile.shared_contact = 1;
            tile.still = u32::from(shared.still);
            tile.up_values = shared.across.values.len() as u32;
            tile.across.more = shared.across.samples() as u32;
            tile.up.more = shared.up.samples() as u32;
            firsts[5] = shared.across.first.len();
            words.extend_from_slice(&shared.across.first);
            words.extend_from_slice(&shared.up.first);
        }
        let by_place = tile.find_by_place(cells, &firsts).is_some();
        let motions = match shared {
            Some(shared) => resident(gpu, slots, &cells.motions, shared),
            None => filled::<R>(gpu, "no motions", &[], BufferUsages::STORAGE),
        };
        // A table has one entry at least.
        let mut model = bytemuck::bytes_of(&cells.bodies()[0]).to_vec();
        // Some devices require this size of a uniform buffer.
        model.resize(model.len().next_multiple_of(16), 0);
        let model = filled::<R>(gpu, "model", &model, BufferUsages::UNIFORM);
        let bodies = bytemuck::cast_slice(cells.bodies());
        let bodies = filled::<R>(gpu, "bodies", bodies, BufferUsages::STORAGE);
        let storage = BufferUsages::STORAGE;
        let numbers = filled::<R>(gpu, "numbers", bytemuck::cast_slice(&numbers), storage);
        let models = [&model, &bodies];
        let dispatches = dispatch_groups(gpu, &pipelines.sweep, slots, models, &numbers);
        Inputs { model, numbers, motions, tile, by_place, firsts, words, steps, dispatches }
    }

    /// Writes the data of one tile to a side of the device, for the dispatch with a given number. The result is
    /// the buffers for making the cells of the tile.
    pub fn begin(
        &self,
        gpu: &OpenDevice,
        pipelines: &Pipelines,
        slots: &mut Slots,
        (side, number): (usize, u32),
        (all, cells): (&Cells<R>, Range<usize>),
        own: Option<&OwnClocks<R>>,
    ) -> BindGroup {
        let mut tile = self.tile;
        let mut words = self.words.clone();
        let columns = all.tables.grid().shape().0;
        let numbers = all.tables.cells().part(cells.clone());
        let placed = self.by_place && tile.place(columns, numbers).is_some();
        let clocks = match own {
            Some(own) => Some(Cow::Borrowed(&own.numbers)),
            None if !placed => Some(Cow::Owned(listed::clocks(all, cells.clone()))),
            None => None,
        };
        if let Some(clocks) = clocks {
            tile.clock = Layout { first: words.len() as u32, more: 1, ..Layout::default() };
            words.extend_from_slice(&clocks);
        }
        if !placed {
            tile.list(cells.len(), words.len(), &self.firsts);
            words.extend(listed::places(all, cells));
        }
        words.resize(words.len().max(1), 0);
        tile.first_slot = (side * slots.tile) as u32;
        tile.slots = (slots.sides.len() * slots.tile) as u32;
        tile.number = number;
        let place = &mut slots.sides[side];
        refill(gpu, &mut place.tile, bytemuck::bytes_of(&tile));
        refill(gpu, &mut place.words, bytemuck::cast_slice(&words));
        let steps = own.map_or(&self.steps, |own| &own.steps);
        refill(gpu, &mut place.clocks, bytemuck::cast_slice(steps));
        let place = &slots.sides[side];
        bind(
            gpu,
            &pipelines.begin,
            &[
                (0, self.model.as_entire_binding()),
                (1, slots.cells.as_entire_binding()),
                (2, slots.states.as_entire_binding()),
                (4, slots.tally.as_entire_binding()),
                (7, slots.running.as_entire_binding()),
                (8, place.tile.as_entire_binding()),
                (9, self.numbers.as_entire_binding()),
                (10, place.clocks.as_entire_binding()),
                (11, place.words.as_entire_binding()),
                (12, self.motions.as_entire_binding()),
            ],
        )
    }
}

/// True for motions that fit in a buffer of a shader; where they do not fit, cells begin from rest.
fn fits<R: Real>(motions: &FullContactMotions<R>, limit: u64) -> bool {
    let values = motions.across.values.len() + motions.up.values.len();
    let bytes = (values * size_of::<R>()) as u64;
    bytes <= limit && motions.across.longest().max(motions.up.longest()) <= MOST_GAPS
}

/// The buffer of motions that an earlier sweep may have left on the device.
fn resident<R: Real>(
    gpu: &OpenDevice,
    slots: &mut Slots,
    whose: &Arc<Option<FullContactMotions<R>>>,
    motions: &FullContactMotions<R>,
) -> Buffer {
    let whose = Arc::clone(whose) as Arc<dyn Any + Send + Sync>;
    if let Some((known, buffer)) = &slots.motions
        && Arc::ptr_eq(known, &whose)
    {
        return buffer.clone();
    }
    // The motions of two sweeps need not be on the device at once.
    slots.motions = None;
    let size = size_of_val(&motions.across.values[..]) + size_of_val(&motions.up.values[..]);
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
    let buffer = super::slots::buffer(gpu, "motions", size as u64, usage);
    gpu.queue.write_buffer(&buffer, 0, bytemuck::cast_slice(&motions.across.values));
    let first = size_of_val(&motions.across.values[..]) as u64;
    gpu.queue.write_buffer(&buffer, first, bytemuck::cast_slice(&motions.up.values));
    slots.motions = Some((whose, buffer.clone()));
    buffer
}

fn bind(
    gpu: &OpenDevice,
    pipeline: &ComputePipeline,
    bound: &[(u32, BindingResource)],
) -> BindGroup {
    let entries: Vec<BindGroupEntry> = bound
        .iter()
        .map(|(binding, resource)| BindGroupEntry { binding: *binding, resource: resource.clone() })
        .collect();
    gpu.device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    })
}

fn dispatch_groups(
    gpu: &OpenDevice,
    pipeline: &ComputePipeline,
    slots: &Slots,
    [model, bodies]: [&Buffer; 2],
    record: &Buffer,
) -> [BindGroup; RING] {
    std::array::from_fn(|place| {
        let dispatch = BindingResource::Buffer(BufferBinding {
            buffer: &slots.dispatch,
            offset: place as u64 * DISPATCH_STRIDE,
            size: BufferSize::new(16),
        });
        let mut bound = vec![
            (0, model.as_entire_binding()),
            (1, slots.cells.as_entire_binding()),
            (2, slots.states.as_entire_binding()),
            (3, dispatch),
            (4, slots.tally.as_entire_binding()),
            (5, record.as_entire_binding()),
            (7, slots.running.as_entire_binding()),
            (13, bodies.as_entire_binding()),
        ];
        if let Some(events) = &slots.events {
            bound.push((6, events.as_entire_binding()));
        }
        bind(gpu, pipeline, &bound)
    })
}
