//! Tiles of cells, some on the device at once.
//!
//! The running cells of all of them are in one list. It is made again after every dispatch, so that every thread has a
//! cell, even where cells have very different lengths. When few cells run, those of the next tile are made and join
//! them. A tile whose last cell is done is read while the device continues.
//!
//! All cells of the list get their turns in every dispatch, so that their order does not matter. Long cells end last,
//! together with the first cells of the next tile.

use std::array::from_fn;
use std::collections::VecDeque;
use std::ops::Range;
use std::time::{Duration, Instant};

use super::BackendError;
use super::device::OpenDevice;
use super::inputs::Inputs;
use super::loaded::LoadedTile;
use super::outcomes::DeviceRun;
use super::pipelines::Pipelines;
use super::slots::{FLIGHTS, SIDES, Slots, TALLY};
use super::submission::{Begin, Flight, Order, Report, receive, submit};
use super::tile::OwnClocks;
use crate::backend::sink::Sink;
use crate::cells::ready::Cells;
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::stepping::guards::{EVENT_BOUND, LOCATE_BOUND};
use crate::work::observer::Observer;

/// The tiles of a sweep.
pub struct Tiles<'a, R> {
    gpu: &'a OpenDevice,
    pipelines: &'a Pipelines,
    slots: &'a mut Slots,
    all: &'a Cells<'a, R>,
    inputs: Inputs<R>,
    sink: Sink<'a>,
    /// The cells that are in no tile yet, by their numbers in the list.
    rest: Range<usize>,
    /// The most cells of a tile.
    most_cells: usize,
    /// Tiles whose cells run.
    sides: [Option<LoadedTile<R>>; SIDES],
    /// Tiles whose last states are being copied to the host.
    copied: [Option<LoadedTile<R>>; SIDES],
    flights: VecDeque<Flight>,
    /// The counts of submissions made and reported, of dispatches, and of tiles begun and read.
    submitted: usize,
    heard: usize,
    dispatches: u32,
    begun: usize,
    read: usize,
    /// The number of cells that ran after the last reported submission.
    running: usize,
    /// The reported steps, modulo 2^32 and in all, and the most steps that the tiles so far can take.
    steps: u32,
    all_steps: u64,
    most_steps: u64,
    /// The turns of a cell since the last step of any: a step takes a turn for each trial of a search, of each of its switches.
    stalled: u32,
    results: DeviceRun<R>,
}

impl<'a, R: Real> Tiles<'a, R> {
    /// The tiles of the cells of a list, of at most a given number of cells each.
    pub fn new(
        gpu: &'a OpenDevice,
        pipelines: &'a Pipelines,
        slots: &'a mut Slots,
        (all, record): (&'a Cells<'a, R>, &[Ground<R>]),
        most_cells: usize,
        sink: Sink<'a>,
    ) -> Result<Tiles<'a, R>, BackendError> {
        let inputs = gpu.checked(|| {
            gpu.queue.write_buffer(&slots.tally, 0, &[0; TALLY as usize]);
            Inputs::new(gpu, pipelines, slots, all, record)
        })?;
        let cells = all.tables.cells().len();
        let results = DeviceRun {
            done: 0,
            events: Vec::new(),
            device: gpu.has_clock().then_some(Duration::ZERO),
        };
        Ok(Tiles {
            gpu,
            pipelines,
            slots,
            all,
            inputs,
            sink,
            rest: 0..cells,
            most_cells,
            sides: from_fn(|_| None),
            copied: from_fn(|_| None),
            flights: VecDeque::with_capacity(FLIGHTS),
            submitted: 0,
            heard: 0,
            dispatches: 0,
            begun: 0,
            read: 0,
            running: 0,
            steps: 0,
            all_steps: 0,
            most_steps: 0,
            stalled: 0,
            results,
        })
    }

    /// Runs all tiles until all their cells end.
    pub fn run(mut self, observer: &dyn Observer) -> Result<DeviceRun<R>, BackendError> {
        let count = self.rest.len();
        let (mut told, mut ended) = (0, Instant::now());
        loop {
            if observer.cancelled() {
                return Err(BackendError::Cancelled);
            }
            while self.flights.len() < FLIGHTS && self.submit()? {}
            // The host reads while the device works.
            let freed = self.read()?;
            if let Some(flight) = self.flights.pop_front() {
                let report = receive(self.gpu, self.slots, &flight, ended)?;
                ended = Instant::now();
                self.hear(&flight, &report)?;
                let done = self.done();
                observer.advance(done.saturating_sub(told));
                told = told.max(done);
            } else if !freed {
                break;
            }
        }
        if self.results.done < count {
            return Err(BackendError::Unfinished(count - self.results.done));
        }
        observer.advance(count.saturating_sub(told));
        Ok(self.results)
    }

    /// The most cells that may run in the next submission.
    fn bound(&self) -> usize {
        self.running + self.flights.iter().map(|flight| flight.begun).sum::<usize>()
    }

    /// Submits the next work to the device; false where there is none.
    fn submit(&mut self) -> Result<bool, BackendError> {
        let mut copied = [0; SIDES];
        for (side, cells) in copied.iter_mut().enumerate() {
            let ended = self.sides[side].as_ref().is_some_and(|tile| tile.left == 0);
            if ended && self.copied[side].is_none() {
                self.copied[side] = self.sides[side].take();
                *cells = self.copied[side].as_ref().map_or(0, |tile| tile.cells.len());
            }
        }
        let bound = self.bound();
        let free = self.sides.iter().position(Option::is_none);
        let few = bound < self.most_cells.div_ceil(2);
        let begin = match free {
            Some(side) if few && !self.rest.is_empty() => Some(self.begin(side)?),
            _ => None,
        };
        let running = bound + begin.as_ref().map_or(0, |begin| begin.cells);
        let (dispatches, work) = match running {
            0 => (0, 0),
            cells => self.slots.pace.dispatches(cells),
        };
        if copied == [0; SIDES] && dispatches == 0 {
            return Ok(false);
        }
        let (number, groups) = (self.dispatches, &self.inputs.dispatches);
        let order = Order { copied, begin, number, dispatches, work, running, groups };
        let place = self.submitted % FLIGHTS;
        self.flights.push_back(submit(self.gpu, self.pipelines, self.slots, place, &order)?);
        self.submitted += 1;
        self.dispatches = self.dispatches.wrapping_add(dispatches);
        Ok(true)
    }

    /// Prepares the next tile on a side.
    fn begin(&mut self, side: usize) -> Result<Begin, BackendError> {
        let count = self.most_cells.min(self.rest.len());
        let cells = self.rest.start..self.rest.start + count;
        let tables = &self.all.tables;
        let own = OwnClocks::of(tables, cells.clone());
        let longest = match &own {
            Some(own) => own.clocks.iter().map(|clock| clock.steps).max().unwrap_or(0),
            None => tables.longest(),
        };
        let (gpu, number) = (self.gpu, self.dispatches);
        let group = gpu.checked(|| {
            let tile = (self.all, cells.clone());
            self.inputs.begin(gpu, self.pipelines, self.slots, (side, number), tile, own.as_ref())
        })?;
        self.most_steps += count as u64 * u64::from(longest);
        self.sides[side] = Some(LoadedTile {
            number: self.begun,
            cells,
            own,
            longest,
            work: 0,
            since: self.submitted,
            left: count,
            mapped: false,
        });
        self.begun += 1;
        self.rest.start += count;
        Ok(Begin { side, cells: count, group })
    }

    /// Updates the tiles from the report of a submission.
    fn hear(&mut self, flight: &Flight, report: &Report) -> Result<(), BackendError> {
        for side in 0..SIDES {
            if let Some(tile) = self.sides[side].as_mut().filter(|tile| tile.since <= self.heard) {
                tile.left = report.left[side];
                tile.work += u64::from(flight.work);
            }
            if let Some(tile) = self.copied[side].as_mut().filter(|_| flight.copied[side] > 0) {
                tile.mapped = true;
            }
        }
        self.heard += 1;
        self.running = report.running;
        self.results.device = self.results.device.zip(report.device).map(|(sum, pass)| sum + pass);
        if flight.work > 0 {
            let steps = report.steps.wrapping_sub(self.steps);
            self.steps = report.steps;
            self.all_steps += u64::from(steps);
            self.stalled = if steps == 0 { self.stalled.saturating_add(flight.work) } else { 0 };
            // The device makes no progress, or it loses the states that it writes.
            let stalls = self.stalled > EVENT_BOUND.saturating_mul(LOCATE_BOUND);
            if self.running > 0 && (stalls || self.all_steps > self.most_steps) {
                return Err(BackendError::Unfinished(self.running));
            }
            self.slots.pace.learn(flight.work, flight.running, report.host, report.device);
        }
        Ok(())
    }

    /// Computes the outcomes of tiles whose states have arrived, in the order of the tiles; false where there are
    /// none.
    fn read(&mut self) -> Result<bool, BackendError> {
        let mut any = false;
        while let Some(side) = self.copied.iter().position(|tile| {
            tile.as_ref().is_some_and(|tile| tile.mapped && tile.number == self.read)
        }) && let Some(tile) = self.copied[side].take()
        {
            tile.read(self.gpu, self.slots, side, self.all, self.sink, &mut self.results)?;
            self.read += 1;
            any = true;
        }
        Ok(any)
    }

    /// The number of cells that are done; a running cell counts by the share of its steps.
    fn done(&self) -> usize {
        let ended = self.copied.iter().flatten().map(|tile| tile.cells.len()).sum::<usize>();
        let running = self.sides.iter().flatten().map(LoadedTile::done).sum::<usize>();
        self.results.done + ended + running
    }
}
