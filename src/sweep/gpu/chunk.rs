//! Chunks of steps: how much at a time, and one ahead of what the host has seen.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use wgpu::{
    CommandEncoderDescriptor, ComputePassDescriptor, ComputePassTimestampWrites, ComputePipeline,
    SubmissionIndex,
};

use super::GpuError;
use super::device::Gpu;
use super::tile::{FLIGHTS, TALLIES, TALLY, Tile};
use crate::model::excitation::Cell;

/// Threads of a workgroup.
pub const WORKGROUP: usize = 64;
/// What a chunk should take: well below the two seconds after which a desktop driver ends it.
const CHUNK_TIME: Duration = Duration::from_millis(100);
/// Steps and switches of a cell in the first chunk.
const FIRST_CHUNK: u32 = 16;
/// The same in the longest one. Drivers bound the iterations of a shader's loops, the software one
/// silently at 65,535 for all loops together: a switch takes about 15, a hundred at the worst.
const LONGEST_CHUNK: f64 = 2048.0;

/// A chunk on its way.
struct Flight {
    number: usize,
    work: u32,
    submission: SubmissionIndex,
    submitted: Instant,
}

/// What a chunk tells.
struct Told {
    /// Cells that still run after it.
    running: usize,
    /// Steps that all cells took in it.
    steps: u64,
    /// Time in the shader.
    device: Option<Duration>,
}

/// Runs the cells of a tile to their ends, of which `running` have any steps to take; the time in
/// the shader, where the device tells. `progress` hears of cells as they are done, a running one
/// by the share of its steps.
pub fn run<R: crate::model::real::Real>(
    gpu: &Gpu,
    pipeline: &ComputePipeline,
    tile: &Tile,
    cells: &[Cell<R>],
    mut running: usize,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Option<Duration>, GpuError> {
    let count = cells.len();
    let most_steps = cells.iter().map(|cell| cell.steps).max().unwrap_or(0);
    let all_steps: u64 = cells.iter().map(|cell| u64::from(cell.steps)).sum();
    let mut time = gpu.has_clock().then_some(Duration::ZERO);
    let (mut steps_taken, mut most_done, mut told) = (0_u64, 0_u64, 0);
    let mut work = FIRST_CHUNK;
    let mut flights = VecDeque::with_capacity(FLIGHTS);
    let mut number = 0;
    let mut ended = Instant::now();
    while running > 0 {
        while flights.len() < FLIGHTS {
            flights.push_back(submit(gpu, pipeline, tile, number, work, running)?);
            number += 1;
        }
        let Some(flight) = flights.pop_front() else { break };
        let seen = receive(gpu, tile, &flight)?;
        // It began when it was submitted, or when the one before it ended.
        let began = ended.max(flight.submitted);
        ended = Instant::now();
        running = seen.running;
        time = time.zip(seen.device).map(|(sum, chunk)| sum + chunk);
        // Switches count as work too, so that this is an upper bound.
        most_done += u64::from(flight.work);
        let share = (most_done as f64 / f64::from(most_steps.max(1))).min(0.99);
        let done = count - running + (share * running as f64) as usize;
        progress(done.saturating_sub(told));
        told = told.max(done);
        // A device that stands still, or whose states do not come to stay.
        steps_taken += seen.steps;
        if running > 0 && (seen.steps == 0 || steps_taken > all_steps) {
            return Err(GpuError::Unfinished(running));
        }
        let took = seen.device.unwrap_or(ended - began).as_secs_f64().max(1.0e-6);
        let ratio = CHUNK_TIME.as_secs_f64() / took;
        work = (f64::from(flight.work) * ratio.clamp(0.25, 4.0)).clamp(1.0, LONGEST_CHUNK) as u32;
    }
    progress(count.saturating_sub(told));
    Ok(time)
}

/// Hands a chunk of at most `running` cells to the device.
fn submit(
    gpu: &Gpu,
    pipeline: &ComputePipeline,
    tile: &Tile,
    number: usize,
    work: u32,
    running: usize,
) -> Result<Flight, GpuError> {
    let place = number % FLIGHTS;
    let submission = gpu.checked(|| {
        // A tile has fewer than 2^32 cells, and takes fewer chunks than steps.
        let chunk = [tile.cells as u32, work, number as u32, 0];
        gpu.queue.write_buffer(&tile.chunk, 0, bytemuck::cast_slice(&chunk));
        let descriptor = CommandEncoderDescriptor { label: Some("chunk") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        let tally = (number as u64 + 1) % TALLIES * TALLY;
        encoder.clear_buffer(&tile.tallies, tally, Some(TALLY));
        let clock = tile.clocks.as_ref().map(|clocks| &clocks[place]);
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: None,
            timestamp_writes: clock.map(|clock| ComputePassTimestampWrites {
                query_set: &clock.queries,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            }),
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &tile.bind_group, &[]);
        pass.dispatch_workgroups(running.div_ceil(WORKGROUP) as u32, 1, 1);
        drop(pass);
        let back = &tile.back[place];
        encoder.copy_buffer_to_buffer(&tile.tallies, tally, back, 0, Some(TALLY));
        if let Some(clock) = clock {
            encoder.resolve_query_set(&clock.queries, 0..2, &clock.ticks, 0);
            encoder.copy_buffer_to_buffer(&clock.ticks, 0, back, TALLY, Some(16));
        }
        gpu.queue.submit([encoder.finish()])
    })?;
    Ok(Flight { number, work, submission, submitted: Instant::now() })
}

/// Waits for a chunk.
fn receive(gpu: &Gpu, tile: &Tile, flight: &Flight) -> Result<Told, GpuError> {
    let back = &tile.back[flight.number % FLIGHTS];
    let bytes = gpu.read(back, Some(flight.submission.clone()))?;
    let [running, steps] = bytemuck::pod_read_unaligned::<[u32; 2]>(&bytes[..8]);
    let device = tile.clocks.as_ref().map(|_| {
        let [began, ended] = bytemuck::pod_read_unaligned::<[u64; 2]>(&bytes[8..]);
        let tick = f64::from(gpu.queue.get_timestamp_period());
        Duration::from_nanos((ended.saturating_sub(began) as f64 * tick) as u64)
    });
    Ok(Told { running: running as usize, steps: u64::from(steps), device })
}
