//! The cells that a device makes, for a comparison with those of the host.

use wgpu::{BufferDescriptor, BufferUsages, CommandEncoderDescriptor};

use super::BackendError;
use super::inputs::Inputs;
use super::run::Sweeper;
use super::slots::{SIDES, Slots};
use super::submission::{Begin, Order, receive, submit};
use super::tile::OwnClocks;
use crate::cells::plan::Plan;
use crate::cells::ready::Cells;
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::scene::Grid;
use crate::stepping::state::State;
use crate::work::observer::Unwatched;

/// Cells of a tile as a device makes them.
pub struct Made<R> {
    /// Their numbers.
    pub cells: Vec<Cell<R>>,
    /// Their first states.
    pub states: Vec<State<R>>,
    /// The cells that are to run, in the order in which threads take them.
    pub running: Vec<u32>,
}

impl Sweeper<'_> {
    /// Makes cells of a grid in one tile, on one of the sides, and runs none of them.
    ///
    /// # Errors
    /// Any [`BackendError`].
    pub fn make<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        side: usize,
    ) -> Result<Made<R>, BackendError> {
        let (gpu, record) = (self.gpu, plan.record::<R>());
        let all = Cells::of(plan, grid, cells, &record, &Unwatched);
        let own = OwnClocks::of(&all.tables, 0..cells.len());
        let (slots, inputs, group) = gpu.checked(|| {
            let mut slots = Slots::new::<R>(gpu, cells.len(), self.events_kept);
            let inputs = Inputs::new(gpu, &self.pipelines, &mut slots, &all, &record);
            let tile = (&all, 0..cells.len());
            let group =
                inputs.begin(gpu, &self.pipelines, &mut slots, (side, 0), tile, own.as_ref());
            (slots, inputs, group)
        })?;
        let order = Order {
            copied: [0; SIDES],
            begin: Some(Begin { side, cells: cells.len(), group }),
            number: 0,
            dispatches: 0,
            work: 0,
            running: 0,
            groups: &inputs.dispatches,
        };
        let flight = submit(gpu, &self.pipelines, &slots, 0, &order)?;
        let report = receive(gpu, &slots, &flight, std::time::Instant::now())?;
        let range = side * cells.len()..(side + 1) * cells.len();
        Ok(Made {
            cells: self.contents(&slots.cells, range.clone())?,
            states: self.contents(&slots.states, range)?,
            running: self.contents(&slots.running, 0..report.running)?,
        })
    }

    /// Some items of a buffer.
    fn contents<T: bytemuck::Pod>(
        &self,
        buffer: &wgpu::Buffer,
        items: std::ops::Range<usize>,
    ) -> Result<Vec<T>, BackendError> {
        let (gpu, size) = (self.gpu, size_of::<T>());
        if items.is_empty() {
            return Ok(Vec::new());
        }
        let back = gpu.checked(|| {
            let back = gpu.device.create_buffer(&BufferDescriptor {
                label: Some("contents"),
                size: (items.len() * size) as u64,
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let descriptor = CommandEncoderDescriptor { label: Some("contents") };
            let mut encoder = gpu.device.create_command_encoder(&descriptor);
            let first = (items.start * size) as u64;
            encoder.copy_buffer_to_buffer(buffer, first, &back, 0, Some(back.size()));
            gpu.queue.submit([encoder.finish()]);
            back
        })?;
        gpu.map(&[&back], None)?;
        Ok(bytemuck::pod_collect_to_vec(&gpu.view(&back)?))
    }
}
