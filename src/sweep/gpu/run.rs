//! A sweep on a device: tiles of cells, chunks of steps.

use std::sync::Arc;
use std::time::Duration;

use rayon::prelude::*;
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoderDescriptor, ComputePipeline,
    ComputePipelineDescriptor, PipelineCompilationOptions, ShaderModuleDescriptor, ShaderSource,
};

use super::super::backend::Precision;
use super::super::full_contact::{Tracks, start};
use super::super::plan::Plan;
use super::GpuError;
use super::chunk::{self, WORKGROUP};
use super::device::Gpu;
use super::shader::{self, Switches};
use super::tile::Tile;
use crate::model::excitation::Cell;
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::Grid;
use crate::stepping::log::Event;
use crate::stepping::outcome::Outcome;
use crate::stepping::state::{PROVED, RUNNING, State};

/// Most cells that are on the device at once.
const MOST_CELLS: usize = 1 << 20;
/// The compiled sweep of a scene.
pub struct Sweeper<'a> {
    gpu: &'a Gpu,
    pipeline: ComputePipeline,
    events_kept: usize,
}

/// What all tiles of a sweep share.
struct Shared<'a, R> {
    plan: &'a Plan,
    grid: &'a Grid,
    tracks: Arc<Option<Tracks<R>>>,
    record: Buffer,
    progress: &'a (dyn Fn(usize) + Sync),
}

/// A tile made ready.
struct Prepared<R> {
    cells: Vec<Cell<R>>,
    states: Vec<State<R>>,
}

/// What a device made of cells.
pub struct Ran<R> {
    /// One a cell, in their order.
    pub outcomes: Vec<Outcome>,
    /// The first switches of each cell, as many for each as were asked for.
    pub events: Vec<Event<R>>,
    /// Time in the shader, by the device's clock; none on a device that has no such clock.
    pub device: Option<Duration>,
}

impl<'a> Sweeper<'a> {
    /// Compiles the shader for a variant of the model.
    ///
    /// # Errors
    /// [`GpuError::Refused`].
    pub fn new(
        gpu: &'a Gpu,
        precision: Precision,
        variant: Variant,
    ) -> Result<Sweeper<'a>, GpuError> {
        let compile = || compile(gpu, &shader::source(precision, Switches::Forgotten), variant, 0);
        let pipeline = gpu.pipeline((precision, variant), compile)?;
        Ok(Sweeper { gpu, pipeline, events_kept: 0 })
    }

    /// Compiles a shader that keeps the first `events_kept` switches of each cell.
    ///
    /// # Errors
    /// [`GpuError::Refused`].
    pub fn keeping(
        gpu: &'a Gpu,
        precision: Precision,
        variant: Variant,
        events_kept: usize,
    ) -> Result<Sweeper<'a>, GpuError> {
        let source = shader::source(precision, Switches::Kept);
        Sweeper::from_source(gpu, &source, variant, events_kept)
    }

    /// Compiles a shader given as text, such as an altered one. It must keep switches if
    /// `events_kept` is not zero.
    ///
    /// # Errors
    /// [`GpuError::Refused`].
    pub fn from_source(
        gpu: &'a Gpu,
        source: &str,
        variant: Variant,
        events_kept: usize,
    ) -> Result<Sweeper<'a>, GpuError> {
        let pipeline = compile(gpu, source, variant, events_kept)?;
        Ok(Sweeper { gpu, pipeline, events_kept })
    }

    /// Runs cells of a grid; `progress` hears of cells as they are done, a running one
    /// by the share of its steps.
    ///
    /// # Errors
    /// Any [`GpuError`]; no outcome is returned that the device did not compute.
    pub fn sweep<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Ran<R>, GpuError> {
        let mut ran = Ran {
            outcomes: Vec::new(),
            events: Vec::new(),
            device: self.gpu.has_clock().then_some(Duration::ZERO),
        };
        let samples = plan.record::<R>();
        let tracks = plan.tracks(grid, &samples);
        let record = self.gpu.checked(|| Tile::record(self.gpu, &samples))?;
        let shared = Shared { plan, grid, tracks, record, progress };
        // While a tile is on the device, the host makes the next one ready and the last one's
        // outcomes.
        let tiles: Vec<&[usize]> = cells.chunks(self.tile_size::<R>()).collect();
        let mut outcomes = Vec::with_capacity(cells.len());
        let conclude = |outcomes: &mut Vec<Outcome>, states: &[State<R>], indices: &[usize]| {
            let ended = states.par_iter().zip(indices);
            outcomes.par_extend(ended.map(|(state, &i)| plan.outcome(&grid.point(i), state)));
        };
        let mut next = tiles.first().map(|first| Sweeper::prepare(&shared, first));
        let mut last: Option<(Vec<State<R>>, &[usize])> = None;
        for (number, indices) in tiles.iter().enumerate() {
            let Some(prepared) = next.take() else { break };
            let (states, ()) = rayon::join(
                || self.tile(&shared, &prepared, &mut ran),
                || {
                    if let Some((states, indices)) = last.take() {
                        conclude(&mut outcomes, &states, indices);
                    }
                    next = tiles.get(number + 1).map(|next| Sweeper::prepare(&shared, next));
                },
            );
            last = Some((states?, indices));
        }
        if let Some((states, indices)) = last {
            conclude(&mut outcomes, &states, indices);
        }
        ran.outcomes = outcomes;
        Ok(ran)
    }

    fn tile_size<R: Real>(&self) -> usize {
        let limits = self.gpu.device.limits();
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let groups = limits.max_compute_workgroups_per_dimension as usize;
        let by_memory = usize::try_from(bytes).unwrap_or(usize::MAX)
            / size_of::<State<R>>().max(self.events_kept * size_of::<Event<R>>());
        MOST_CELLS.min(by_memory).min(groups.saturating_mul(WORKGROUP)).max(1)
    }

    /// A tile's cells and the states that they start in.
    fn prepare<R: Real>(shared: &Shared<R>, indices: &[usize]) -> Prepared<R> {
        let Shared { plan, grid, tracks, .. } = shared;
        let begun = |&index: &usize| {
            let (_, cell, state) = start(plan, grid, index, tracks.as_ref().as_ref());
            (cell, state)
        };
        let (cells, states) = indices.par_iter().map(begun).unzip();
        Prepared { cells, states }
    }

    /// Runs a tile on the device, to its cells' last states.
    fn tile<R: Real>(
        &self,
        shared: &Shared<R>,
        prepared: &Prepared<R>,
        ran: &mut Ran<R>,
    ) -> Result<Vec<State<R>>, GpuError> {
        let Prepared { cells, states } = prepared;
        let model = shared.plan.model::<R>();
        let tile = self.gpu.checked(|| {
            let (record, kept) = (&shared.record, self.events_kept);
            Tile::new(self.gpu, &self.pipeline, &model, cells, states, record, kept)
        })?;
        let running = states.iter().filter(|state| state.status == RUNNING).count();
        let time = chunk::run(self.gpu, &self.pipeline, &tile, cells, running, shared.progress)?;
        ran.device = ran.device.zip(time).map(|(sum, tile)| sum + tile);
        let bytes = self.gpu.read(&self.copy_back(&tile.states)?, None)?;
        let states: Vec<State<R>> = bytemuck::pod_collect_to_vec(&bytes);
        // A cell that is still running, or in no status at all, was never computed.
        let unfinished = states.iter().filter(|s| s.status == RUNNING || s.status > PROVED).count();
        if unfinished > 0 || states.len() != cells.len() {
            let missing = cells.len() - states.len().min(cells.len());
            return Err(GpuError::Unfinished(unfinished.max(missing)));
        }
        if let Some(events) = &tile.events {
            let bytes = self.gpu.read(&self.copy_back(events)?, None)?;
            ran.events.extend_from_slice(bytemuck::cast_slice(&bytes));
        }
        Ok(states)
    }

    /// The contents of a buffer in one that can be read.
    fn copy_back(&self, buffer: &Buffer) -> Result<Buffer, GpuError> {
        let gpu = self.gpu;
        gpu.checked(|| {
            let back = gpu.device.create_buffer(&BufferDescriptor {
                label: Some("back"),
                size: buffer.size(),
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = gpu
                .device
                .create_command_encoder(&CommandEncoderDescriptor { label: Some("back") });
            encoder.copy_buffer_to_buffer(buffer, 0, &back, 0, None);
            gpu.queue.submit([encoder.finish()]);
            back
        })
    }
}

/// Compiles a shader's text.
fn compile(
    gpu: &Gpu,
    source: &str,
    variant: Variant,
    events_kept: usize,
) -> Result<ComputePipeline, GpuError> {
    let mut constants = vec![
        ("recorded", f64::from(u8::from(variant.recorded))),
        ("isolated_h", f64::from(u8::from(variant.isolated_h))),
        ("isolated_v", f64::from(u8::from(variant.isolated_v))),
        ("kinks", f64::from(u8::from(variant.kinks))),
        ("yields", f64::from(u8::from(variant.yields))),
        ("certificate", f64::from(u8::from(variant.certificate))),
        ("bouc_wen_n", f64::from(variant.bouc_wen_n)),
        ("workgroup_size", WORKGROUP as f64),
    ];
    if events_kept > 0 {
        constants.push(("events_kept", events_kept as f64));
    }
    gpu.checked(|| {
        let module = gpu.device.create_shader_module(ShaderModuleDescriptor {
            label: Some("sweep"),
            source: ShaderSource::Wgsl(source.into()),
        });
        gpu.device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: Some("sweep"),
            layout: None,
            module: &module,
            entry_point: Some("sweep"),
            compilation_options: PipelineCompilationOptions {
                constants: &constants,
                ..PipelineCompilationOptions::default()
            },
            cache: None,
        })
    })
}
