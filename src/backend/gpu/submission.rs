//! A submission to the device: it makes cells, runs dispatches, and returns a report.

use std::array::from_fn;
use std::time::{Duration, Instant};

use wgpu::{
    BindGroup, CommandEncoder, CommandEncoderDescriptor, ComputePassDescriptor,
    ComputePassTimestampWrites, SubmissionIndex,
};

use super::BackendError;
use super::device::OpenDevice;
use super::pipelines::{Pipelines, WORKGROUP};
use super::slots::{DISPATCH_STRIDE, RING, SIDES, Slots, TALLY, TALLY_WORDS};

/// The cells that a submission makes.
pub struct Begin {
    /// The side of their tile.
    pub side: usize,
    /// The number of cells.
    pub cells: usize,
    /// The buffers that they use.
    pub group: BindGroup,
}

/// The work of a submission.
pub struct Order<'a> {
    /// The sides whose last states are copied to memory that the host can read.
    pub copied: [usize; SIDES],
    /// The cells that are made after that.
    pub begin: Option<Begin>,
    /// The number of the first dispatch.
    pub number: u32,
    /// The number of dispatches.
    pub dispatches: u32,
    /// The turns of a cell in each.
    pub work: u32,
    /// The most cells that run.
    pub running: usize,
    /// The buffers of the dispatches.
    pub groups: &'a [BindGroup; RING],
}

/// A submission that the device has not finished.
pub struct Flight {
    /// The place of its buffers.
    pub place: usize,
    /// The number of the dispatch after it.
    pub number: u32,
    /// The turns of a cell in it.
    pub work: u32,
    /// The most cells that ran in it.
    pub running: usize,
    /// The number of cells made in it.
    pub begun: usize,
    /// The number of cells of each side that were copied.
    pub copied: [usize; SIDES],
    submission: SubmissionIndex,
    submitted: Instant,
    timed: bool,
}

/// The report of a submission.
pub struct Report {
    /// The number of cells that still run after it.
    pub running: usize,
    /// The same for each side.
    pub left: [usize; SIDES],
    /// The steps that all cells took so far, modulo 2^32.
    pub steps: u32,
    /// The time in the shader.
    pub device: Option<Duration>,
    /// The time from the submission, or from the end of the submission before it, to its end.
    pub host: Duration,
}

/// Gives a submission to the device.
pub fn submit(
    gpu: &OpenDevice,
    pipelines: &Pipelines,
    slots: &Slots,
    place: usize,
    order: &Order,
) -> Result<Flight, BackendError> {
    let timed = order.begin.is_some() || order.dispatches > 0;
    let submission = gpu.checked(|| {
        let size = (SIDES * slots.tile) as u32;
        for place in 0..RING {
            let dispatch = [size, order.work, place as u32, 0];
            let place = place as u64 * DISPATCH_STRIDE;
            gpu.queue.write_buffer(&slots.dispatch, place, bytemuck::cast_slice(&dispatch));
        }
        let descriptor = CommandEncoderDescriptor { label: Some("dispatches") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        for (side, cells) in order.copied.into_iter().enumerate() {
            copy_back(&mut encoder, slots, side, cells);
        }
        if let Some(begin) = &order.begin {
            clear(&mut encoder, slots, begin);
        }
        let flight = &slots.flights[place];
        if timed {
            run(&mut encoder, pipelines, slots, place, order);
            if let Some((queries, ticks)) = &flight.clock {
                encoder.resolve_query_set(queries, 0..2, ticks, 0);
                encoder.copy_buffer_to_buffer(ticks, 0, &flight.back, TALLY, Some(16));
            }
        }
        encoder.copy_buffer_to_buffer(&slots.tally, 0, &flight.back, 0, Some(TALLY));
        gpu.queue.submit([encoder.finish()])
    })?;
    Ok(Flight {
        place,
        number: order.number.wrapping_add(order.dispatches),
        work: order.dispatches * order.work,
        running: order.running,
        begun: order.begin.as_ref().map_or(0, |begin| begin.cells),
        copied: order.copied,
        submission,
        submitted: Instant::now(),
        timed,
    })
}

/// Copies the last states of the cells of a side to memory that the host can read.
fn copy_back(encoder: &mut CommandEncoder, slots: &Slots, side: usize, cells: usize) {
    let mut copy = |from, to, size: u64| {
        let first = (side * slots.tile) as u64 * size;
        encoder.copy_buffer_to_buffer(from, first, to, 0, Some(cells as u64 * size));
    };
    if cells > 0 {
        copy(&slots.states, &slots.sides[side].states_back, slots.state_size);
        if let (Some(from), Some(to)) = (&slots.events, &slots.sides[side].events_back) {
            copy(from, to, slots.events_size);
        }
    }
}

/// Clears the states of earlier cells, so that none of them is read as the state of a cell that was never made.
fn clear(encoder: &mut CommandEncoder, slots: &Slots, begin: &Begin) {
    let mut clear = |buffer, size: u64| {
        let first = (begin.side * slots.tile) as u64 * size;
        encoder.clear_buffer(buffer, first, Some(begin.cells as u64 * size));
    };
    clear(&slots.states, slots.state_size);
    if let Some(events) = &slots.events {
        clear(events, slots.events_size);
    }
}

fn run(
    encoder: &mut CommandEncoder,
    pipelines: &Pipelines,
    slots: &Slots,
    place: usize,
    order: &Order,
) {
    let clock = slots.flights[place].clock.as_ref();
    let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
        label: None,
        timestamp_writes: clock.map(|(queries, _)| ComputePassTimestampWrites {
            query_set: queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }),
    });
    if let Some(begin) = &order.begin {
        pass.set_pipeline(&pipelines.begin);
        pass.set_bind_group(0, &begin.group, &[]);
        pass.dispatch_workgroups(begin.cells.div_ceil(WORKGROUP) as u32, 1, 1);
    }
    pass.set_pipeline(&pipelines.sweep);
    for dispatch in 0..order.dispatches {
        let number = order.number.wrapping_add(dispatch) as usize % RING;
        pass.set_bind_group(0, &order.groups[number], &[]);
        pass.dispatch_workgroups(order.running.div_ceil(WORKGROUP) as u32, 1, 1);
    }
}

/// Waits for a submission; its time counts from the end of the one before it. Afterwards the states that it copied
/// are mapped.
pub fn receive(
    gpu: &OpenDevice,
    slots: &Slots,
    flight: &Flight,
    since: Instant,
) -> Result<Report, BackendError> {
    let back = &slots.flights[flight.place].back;
    let mut mapped = vec![back];
    for (side, cells) in slots.sides.iter().zip(flight.copied) {
        if cells > 0 {
            mapped.push(&side.states_back);
            mapped.extend(&side.events_back);
        }
    }
    gpu.map(&mapped, Some(flight.submission.clone()))?;
    let view = gpu.view(back)?;
    let (tally, ticks) = view.split_at(TALLY as usize);
    let tally: [u32; TALLY_WORDS] = bytemuck::pod_read_unaligned(tally);
    let [began, ended]: [u64; 2] = bytemuck::pod_read_unaligned(&ticks[..16]);
    drop(view);
    back.unmap();
    let tick = f64::from(gpu.queue.get_timestamp_period());
    let pass = Duration::from_nanos((ended.saturating_sub(began) as f64 * tick) as u64);
    Ok(Report {
        running: tally[flight.number as usize % RING] as usize,
        left: from_fn(|side| tally[RING + side] as usize),
        steps: tally[RING + SIDES],
        device: (flight.timed && gpu.has_clock()).then_some(pass),
        host: since.max(flight.submitted).elapsed(),
    })
}
