//! A sweep on a device.

use std::sync::atomic::Ordering;
use std::time::Duration;

use super::BackendError;
use super::opened::Gpu;
use super::outcomes::DeviceRun;
use super::pipelines::{Pipelines, compile};
use super::shader::{self, Switches};
use super::slots::{SIDES, Slots};
use super::tiles::Tiles;
use crate::backend::sink::{Sink, collected};
use crate::cells::cell_list::CellList;
use crate::cells::plan::Plan;
use crate::cells::ready::Cells;
use crate::model::excitation::Cell;
use crate::model::isolation::Variant;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::results::block::Block;
use crate::scene::Grid;
use crate::stepping::log::Event;
use crate::stepping::state::State;
use crate::work::observer::Observer;

/// The most cells of a tile: the last long cells of a tile keep few threads busy, so that few large tiles waste less
/// than many small ones.
pub const MOST_CELLS: usize = 1 << 20;
/// The same on a software adapter, where the states then fit in the caches of the processor.
const MOST_CELLS_SOFTWARE: usize = 1 << 14;

/// The outcomes of the cells that a device computed, and the time that it took.
pub struct DeviceOutcomes<R> {
    /// The columns of the outcomes, in the order of the cells.
    pub block: Block,
    /// The first switches of each cell, the requested number for each.
    pub events: Vec<Event<R>>,
    /// The time in the shader by the clock of the device; none where the device has no clock.
    pub device: Option<Duration>,
}

/// The compiled sweep of a scene.
pub struct Sweeper<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) pipelines: Pipelines,
    pub(crate) events_kept: usize,
    most_cells: usize,
}

impl<'a> Sweeper<'a> {
    /// Compiles the shader for a variant of the model.
    ///
    /// # Errors
    /// [`BackendError::Refused`].
    pub fn new(
        gpu: &'a Gpu,
        precision: Precision,
        variant: Variant,
    ) -> Result<Sweeper<'a>, BackendError> {
        let compile = || compile(gpu, &shader::source(precision, Switches::Forgotten), variant, 0);
        let pipelines = gpu.pipelines((precision, variant), compile)?;
        Ok(Sweeper::of(gpu, pipelines, 0))
    }

    /// Compiles a shader that keeps the first `events_kept` switches of each cell.
    ///
    /// # Errors
    /// [`BackendError::Refused`].
    pub fn keeping(
        gpu: &'a Gpu,
        precision: Precision,
        variant: Variant,
        events_kept: usize,
    ) -> Result<Sweeper<'a>, BackendError> {
        let source = shader::source(precision, Switches::Kept);
        Sweeper::from_source(gpu, &source, variant, events_kept)
    }

    /// Compiles a shader given as text, for example a changed one. It must keep switches if `events_kept` is not
    /// zero.
    ///
    /// # Errors
    /// [`BackendError::Refused`].
    pub fn from_source(
        gpu: &'a Gpu,
        source: &str,
        variant: Variant,
        events_kept: usize,
    ) -> Result<Sweeper<'a>, BackendError> {
        let pipelines = compile(gpu, source, variant, events_kept)?;
        Ok(Sweeper::of(gpu, pipelines, events_kept))
    }

    fn of(gpu: &'a Gpu, pipelines: Pipelines, events_kept: usize) -> Sweeper<'a> {
        let software = gpu.description.kind == "software";
        let most_cells = if software { MOST_CELLS_SOFTWARE } else { MOST_CELLS };
        Sweeper { gpu, pipelines, events_kept, most_cells }
    }

    /// The same with tiles of at most a given number of cells, for tests with many small tiles.
    pub fn in_tiles_of(self, cells: usize) -> Sweeper<'a> {
        Sweeper { most_cells: cells, ..self }
    }

    /// Runs cells of a grid, and collects their outcomes; see [`Sweeper::sweep_into`].
    ///
    /// # Errors
    /// Those of [`Sweeper::sweep_into`].
    pub fn sweep<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        observer: &dyn Observer,
    ) -> Result<DeviceOutcomes<R>, BackendError> {
        let into = |sink: Sink| self.sweep_into(plan, grid, cells.into(), sink, observer);
        let (block, ran) = collected(cells.len(), R::PRECISION, into);
        let DeviceRun { events, device, .. } = ran?;
        Ok(DeviceOutcomes { block, events, device })
    }

    /// Runs cells of a grid, and hands over their outcomes. `observer` is told of cells as they are done; a running
    /// cell counts by the share of its steps.
    ///
    /// # Errors
    /// Any [`BackendError`]; no outcome is handed over that the device did not compute.
    pub fn sweep_into<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: CellList,
        sink: Sink,
        observer: &dyn Observer,
    ) -> Result<DeviceRun<R>, BackendError> {
        let record = plan.record::<R>();
        let all = Cells::of(plan, grid, cells, &record, observer);
        let mut tile = self.tile_size::<R>().min(cells.len().next_power_of_two());
        let slots = self.gpu.slots(|slots| slots.suit::<R>(tile, self.events_kept));
        let mut slots = match slots {
            Some(slots) => slots,
            None => loop {
                match self.gpu.checked(|| Slots::new::<R>(self.gpu, tile, self.events_kept)) {
                    Err(BackendError::OutOfMemory(_)) if tile > MOST_CELLS_SOFTWARE => {
                        tile /= 2;
                        self.gpu.most_cells.store(tile, Ordering::Relaxed);
                    }
                    made => break made?,
                }
            },
        };
        let scene = (&all, &record[..]);
        let tiles = Tiles::new(self.gpu, &self.pipelines, &mut slots, scene, tile, sink)?;
        let results = tiles.run(observer)?;
        // After a failure the buffers are not used again.
        self.gpu.keep(slots);
        Ok(results)
    }

    /// The most cells of a tile.
    fn tile_size<R: Real>(&self) -> usize {
        let limits = self.gpu.device.limits();
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let events = self.events_kept * size_of::<Event<R>>();
        let cell = size_of::<State<R>>().max(size_of::<Cell<R>>()).max(events);
        let by_memory = usize::try_from(bytes).unwrap_or(usize::MAX) / (SIDES * cell);
        let found = self.gpu.most_cells.load(Ordering::Relaxed);
        self.most_cells.min(by_memory).min(found).max(1)
    }
}
