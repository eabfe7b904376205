//! A sweep on a device: tiles of cells, chunks of steps.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoderDescriptor, ComputePassDescriptor,
    ComputePassTimestampWrites, ComputePipeline, ComputePipelineDescriptor,
    PipelineCompilationOptions, ShaderModuleDescriptor, ShaderSource,
};

use super::super::backend::Precision;
use super::super::full_contact::Tracks;
use super::super::plan::Plan;
use super::GpuError;
use super::device::Gpu;
use super::shader::{self, Switches};
use super::tile::Tile;
use crate::integrate::log::Event;
use crate::integrate::outcome::Outcome;
use crate::integrate::state::{PROVED, RUNNING, State};
use crate::model::excitation::Cell;
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::Grid;

/// Threads of a workgroup.
const WORKGROUP: usize = 64;
/// Most cells that are on the device at once.
const MOST_CELLS: usize = 1 << 20;
/// What a chunk should take: well below the two seconds after which a desktop driver ends it.
const CHUNK_TIME: Duration = Duration::from_millis(100);
/// Steps and switches of a cell in the first chunk.
const FIRST_CHUNK: u32 = 16;
/// The same in the longest one. Drivers bound the iterations of a shader's loops, the software one
/// silently at 65,535 for all loops together: a switch takes about 15, a hundred at the worst.
const LONGEST_CHUNK: f64 = 2048.0;

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
    tracks: Option<Tracks<R>>,
    record: Buffer,
    progress: &'a (dyn Fn(usize) + Sync),
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
        Sweeper::from_source(gpu, &shader::source(precision, Switches::Forgotten), variant, 0)
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
        let mut constants = vec![
            ("recorded", f64::from(u8::from(variant.recorded))),
            ("isolated_h", f64::from(u8::from(variant.isolated_h))),
            ("isolated_v", f64::from(u8::from(variant.isolated_v))),
            ("kinks", f64::from(u8::from(variant.kinks))),
            ("yields", f64::from(u8::from(variant.yields))),
            ("certificate", f64::from(u8::from(variant.certificate))),
            ("in_step", f64::from(u8::from(variant.in_step))),
            ("bouc_wen_n", f64::from(variant.bouc_wen_n)),
            ("workgroup_size", WORKGROUP as f64),
        ];
        if events_kept > 0 {
            constants.push(("events_kept", events_kept as f64));
        }
        let pipeline = gpu.checked(|| {
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
        })?;
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
            outcomes: Vec::with_capacity(cells.len()),
            events: Vec::new(),
            device: self.gpu.has_clock().then_some(Duration::ZERO),
        };
        let samples = plan.record::<R>();
        let tracks = Tracks::of(plan, grid, &samples);
        let record = self.gpu.checked(|| Tile::record(self.gpu, &samples))?;
        let shared = Shared { plan, grid, tracks, record, progress };
        for indices in cells.chunks(self.tile_size::<R>()) {
            self.tile(&shared, indices, &mut ran)?;
        }
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

    fn tile<R: Real>(
        &self,
        shared: &Shared<R>,
        indices: &[usize],
        ran: &mut Ran<R>,
    ) -> Result<(), GpuError> {
        let Shared { plan, grid, tracks, record, progress } = shared;
        let count = indices.len();
        let begun = |&index: &usize| {
            let point = grid.point(index);
            let (cell, mut state) = plan.cell::<R>(&point);
            if let Some(tracks) = tracks {
                tracks.begin(index, &point, &cell, &mut state);
            }
            (cell, state)
        };
        let (cells, states): (Vec<Cell<R>>, Vec<State<R>>) = indices.par_iter().map(begun).unzip();
        let most_steps = cells.iter().map(|cell| cell.steps).max().unwrap_or(0);
        let kept = self.events_kept;
        let tile = self.gpu.checked(|| {
            Tile::new(self.gpu, &self.pipeline, &plan.model::<R>(), &cells, &states, record, kept)
        })?;
        let mut chunk = FIRST_CHUNK;
        let all_steps: u64 = cells.iter().map(|cell| u64::from(cell.steps)).sum();
        let mut steps_taken = 0_u64;
        let mut most_done = 0_u64;
        let mut told = 0;
        loop {
            let began = Instant::now();
            let Chunk { running, steps, device } = self.chunk(&tile, count, chunk)?;
            ran.device = ran.device.zip(device).map(|(sum, chunk)| sum + chunk);
            // Switches count as work too, so that this is an upper bound.
            most_done += u64::from(chunk);
            let share = (most_done as f64 / f64::from(most_steps.max(1))).min(0.99);
            let done = count - running + (share * running as f64) as usize;
            progress(done.saturating_sub(told));
            told = told.max(done);
            if running == 0 {
                break;
            }
            // A device that stands still, or whose states do not come to stay.
            steps_taken += steps;
            if steps == 0 || steps_taken > all_steps {
                return Err(GpuError::Unfinished(running));
            }
            let ratio = CHUNK_TIME.as_secs_f64() / began.elapsed().as_secs_f64().max(1.0e-6);
            chunk = (f64::from(chunk) * ratio.clamp(0.25, 4.0)).clamp(1.0, LONGEST_CHUNK) as u32;
        }
        let bytes = self.gpu.read(&self.copy_back(&tile.states)?)?;
        let states: &[State<R>] = bytemuck::cast_slice(&bytes);
        // A cell that is still running, or in no status at all, was never computed.
        let unfinished = states.iter().filter(|s| s.status == RUNNING || s.status > PROVED).count();
        if unfinished > 0 || states.len() != count {
            return Err(GpuError::Unfinished(unfinished.max(count - states.len().min(count))));
        }
        ran.outcomes.par_extend(
            states
                .par_iter()
                .zip(indices)
                .map(|(state, &index)| plan.outcome(&grid.point(index), state)),
        );
        if let Some(events) = &tile.events {
            let bytes = self.gpu.read(&self.copy_back(events)?)?;
            ran.events.extend_from_slice(bytemuck::cast_slice(&bytes));
        }
        Ok(())
    }

    /// Runs a chunk of every cell.
    fn chunk(&self, tile: &Tile, count: usize, work: u32) -> Result<Chunk, GpuError> {
        let gpu = self.gpu;
        gpu.checked(|| {
            // A tile has fewer than 2^32 cells.
            let chunk = [count as u32, work, 0, 0];
            gpu.queue.write_buffer(&tile.chunk, 0, bytemuck::cast_slice(&chunk));
            let mut encoder = gpu
                .device
                .create_command_encoder(&CommandEncoderDescriptor { label: Some("chunk") });
            encoder.clear_buffer(&tile.progress, 0, None);
            let clock = tile.clock.as_ref();
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
                label: None,
                timestamp_writes: clock.map(|clock| ComputePassTimestampWrites {
                    query_set: &clock.queries,
                    beginning_of_pass_write_index: Some(0),
                    end_of_pass_write_index: Some(1),
                }),
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &tile.bind_group, &[]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
            drop(pass);
            encoder.copy_buffer_to_buffer(&tile.progress, 0, &tile.back, 0, Some(8));
            if let Some(clock) = clock {
                encoder.resolve_query_set(&clock.queries, 0..2, &clock.ticks, 0);
                encoder.copy_buffer_to_buffer(&clock.ticks, 0, &tile.back, 8, Some(16));
            }
            gpu.queue.submit([encoder.finish()]);
        })?;
        let bytes = gpu.read(&tile.back)?;
        let [running, steps] = bytemuck::pod_read_unaligned::<[u32; 2]>(&bytes[..8]);
        let device = tile.clock.as_ref().map(|_| {
            let [began, ended] = bytemuck::pod_read_unaligned::<[u64; 2]>(&bytes[8..]);
            let tick = f64::from(gpu.queue.get_timestamp_period());
            Duration::from_nanos((ended.saturating_sub(began) as f64 * tick) as u64)
        });
        Ok(Chunk { running: running as usize, steps: u64::from(steps), device })
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

/// What a chunk tells.
struct Chunk {
    /// Cells that still run after it.
    running: usize,
    /// Steps that all cells took in it.
    steps: u64,
    /// Time in the shader.
    device: Option<Duration>,
}
