//! A sweep on a device: tiles of cells, chunks of steps.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages,
    CommandEncoderDescriptor, ComputePassDescriptor, ComputePipeline, ComputePipelineDescriptor,
    PipelineCompilationOptions, ShaderModuleDescriptor, ShaderSource,
};

use super::super::backend::Precision;
use super::super::cells::Plan;
use super::GpuError;
use super::device::Gpu;
use super::shader;
use crate::integrate::outcome::Outcome;
use crate::integrate::state::{DIVERGED, RUNNING, State};
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
        Sweeper::from_source(gpu, &shader::source(precision), variant)
    }

    /// Compiles a shader given as text, such as an altered one.
    ///
    /// # Errors
    /// [`GpuError::Refused`].
    pub fn from_source(
        gpu: &'a Gpu,
        source: &str,
        variant: Variant,
    ) -> Result<Sweeper<'a>, GpuError> {
        let constants = [
            ("recorded", f64::from(u8::from(variant.recorded))),
            ("isolated_h", f64::from(u8::from(variant.isolated_h))),
            ("isolated_v", f64::from(u8::from(variant.isolated_v))),
            ("kinks", f64::from(u8::from(variant.kinks))),
            ("bouc_wen_n", f64::from(variant.bouc_wen_n)),
            ("workgroup_size", WORKGROUP as f64),
        ];
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
        Ok(Sweeper { gpu, pipeline })
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
    ) -> Result<Vec<Outcome>, GpuError> {
        let mut outcomes = Vec::with_capacity(cells.len());
        for tile in cells.chunks(self.tile_size::<R>()) {
            outcomes.extend(self.tile::<R>(plan, grid, tile, progress)?);
        }
        Ok(outcomes)
    }

    fn tile_size<R: Real>(&self) -> usize {
        let limits = self.gpu.device.limits();
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let groups = limits.max_compute_workgroups_per_dimension as usize;
        let by_memory = usize::try_from(bytes).unwrap_or(usize::MAX) / size_of::<State<R>>();
        MOST_CELLS.min(by_memory).min(groups.saturating_mul(WORKGROUP)).max(1)
    }

    fn tile<R: Real>(
        &self,
        plan: &Plan,
        grid: &Grid,
        indices: &[usize],
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Outcome>, GpuError> {
        let count = indices.len();
        let (cells, states): (Vec<Cell<R>>, Vec<State<R>>) =
            indices.par_iter().map(|&index| plan.cell::<R>(&grid.point(index))).unzip();
        let most_steps = cells.iter().map(|cell| cell.steps).max().unwrap_or(0);
        let buffers = self.gpu.checked(|| Buffers::new(self.gpu, plan, &cells, &states))?;
        let mut chunk = FIRST_CHUNK;
        let all_steps: u64 = cells.iter().map(|cell| u64::from(cell.steps)).sum();
        let mut steps_taken = 0_u64;
        let mut most_done = 0_u64;
        let mut told = 0;
        loop {
            let began = Instant::now();
            let [running, steps] = self.chunk(&buffers, count, chunk)?;
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
            steps_taken += steps as u64;
            if steps == 0 || steps_taken > all_steps {
                return Err(GpuError::Unfinished(running));
            }
            let ratio = CHUNK_TIME.as_secs_f64() / began.elapsed().as_secs_f64().max(1.0e-6);
            chunk = (f64::from(chunk) * ratio.clamp(0.25, 4.0)).clamp(1.0, LONGEST_CHUNK) as u32;
        }
        let bytes = self.gpu.read(&self.copy_back(&buffers)?)?;
        let states: &[State<R>] = bytemuck::cast_slice(&bytes);
        // A cell that is still running, or in no status at all, was never computed.
        let unfinished =
            states.iter().filter(|s| s.status == RUNNING || s.status > DIVERGED).count();
        if unfinished > 0 || states.len() != count {
            return Err(GpuError::Unfinished(unfinished.max(count - states.len().min(count))));
        }
        Ok(states
            .par_iter()
            .zip(indices)
            .map(|(state, &index)| plan.outcome(&grid.point(index), state))
            .collect())
    }

    /// Runs a chunk of every cell: how many still run, and the steps that all took.
    fn chunk(&self, buffers: &Buffers, count: usize, work: u32) -> Result<[usize; 2], GpuError> {
        let gpu = self.gpu;
        gpu.checked(|| {
            // A tile has fewer than 2^32 cells.
            let chunk = [count as u32, work, 0, 0];
            gpu.queue.write_buffer(&buffers.chunk, 0, bytemuck::cast_slice(&chunk));
            let bind_group = gpu.device.create_bind_group(&BindGroupDescriptor {
                label: Some("sweep"),
                layout: &self.pipeline.get_bind_group_layout(0),
                entries: &buffers.entries(),
            });
            let mut encoder = gpu
                .device
                .create_command_encoder(&CommandEncoderDescriptor { label: Some("chunk") });
            encoder.clear_buffer(&buffers.progress, 0, None);
            let mut pass = encoder
                .begin_compute_pass(&ComputePassDescriptor { label: None, timestamp_writes: None });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bind_group, &[]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
            drop(pass);
            encoder.copy_buffer_to_buffer(&buffers.progress, 0, &buffers.progress_back, 0, Some(8));
            gpu.queue.submit([encoder.finish()]);
        })?;
        let bytes = gpu.read(&buffers.progress_back)?;
        Ok(bytemuck::pod_read_unaligned::<[u32; 2]>(&bytes).map(|count| count as usize))
    }

    /// The states in a buffer that can be read.
    fn copy_back(&self, buffers: &Buffers) -> Result<Buffer, GpuError> {
        let gpu = self.gpu;
        gpu.checked(|| {
            let back = gpu.device.create_buffer(&BufferDescriptor {
                label: Some("states back"),
                size: buffers.states.size(),
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = gpu
                .device
                .create_command_encoder(&CommandEncoderDescriptor { label: Some("back") });
            encoder.copy_buffer_to_buffer(&buffers.states, 0, &back, 0, None);
            gpu.queue.submit([encoder.finish()]);
            back
        })
    }
}

/// The buffers of a tile.
struct Buffers {
    model: Buffer,
    cells: Buffer,
    states: Buffer,
    chunk: Buffer,
    progress: Buffer,
    record: Buffer,
    progress_back: Buffer,
}

impl Buffers {
    fn new<R: Real>(gpu: &Gpu, plan: &Plan, cells: &[Cell<R>], states: &[State<R>]) -> Buffers {
        let filled = |label, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        let empty = |label, usage| {
            let mapped_at_creation = false;
            gpu.device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size: 16,
                usage,
                mapped_at_creation,
            })
        };
        let model = plan.model::<R>();
        let record = plan.record::<R>();
        Buffers {
            model: filled("model", bytemuck::bytes_of(&model), BufferUsages::STORAGE),
            cells: filled("cells", bytemuck::cast_slice(cells), BufferUsages::STORAGE),
            states: filled(
                "states",
                bytemuck::cast_slice(states),
                BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            ),
            chunk: empty("chunk", BufferUsages::UNIFORM | BufferUsages::COPY_DST),
            progress: empty(
                "progress",
                BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST,
            ),
            record: filled("record", bytemuck::cast_slice(&record), BufferUsages::STORAGE),
            progress_back: gpu.device.create_buffer(&BufferDescriptor {
                label: Some("progress back"),
                size: 8,
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            }),
        }
    }

    fn entries(&self) -> [BindGroupEntry<'_>; 6] {
        let buffers =
            [&self.model, &self.cells, &self.states, &self.chunk, &self.progress, &self.record];
        let mut binding = 0;
        buffers.map(|buffer| {
            let entry = BindGroupEntry { binding, resource: buffer.as_entire_binding() };
            binding += 1;
            entry
        })
    }
}
