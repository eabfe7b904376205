//! A tile on the device, from the submission that makes its cells until their outcomes are read.

use std::ops::Range;

use super::device::OpenDevice;
use super::outcomes::DeviceRun;
use super::slots::Slots;
use super::tile::OwnClocks;
use super::{BackendError, outcomes};
use crate::backend::sink::Sink;
use crate::cells::ready::Cells;
use crate::model::real::Real;

/// A tile whose cells are on the device.
pub struct LoadedTile<R> {
    /// Number of the tile.
    pub number: usize,
    /// The cells of the tile, by their numbers in the list.
    pub cells: Range<usize>,
    /// The clocks of the cells, where each has its own.
    pub own: Option<OwnClocks<R>>,
    /// The steps of the longest cell.
    pub longest: u32,
    /// The number of turns that the cells were given so far.
    pub work: u64,
    /// The number of the submission that makes the cells.
    pub since: usize,
    /// The number of cells that still run.
    pub left: usize,
    /// True where the host can read the last states.
    pub mapped: bool,
}

impl<R: Real> LoadedTile<R> {
    /// The number of cells that are done; a running cell counts by the share of its steps. A step takes one turn or
    /// more, so that this is an upper bound.
    pub fn done(&self) -> usize {
        let left = self.left.min(self.cells.len());
        let share = (self.work as f64 / f64::from(self.longest.max(1))).min(0.99);
        self.cells.len() - left + (share * left as f64) as usize
    }

    /// Hands over the outcomes of its cells, whose last states are mapped, after those of the tiles before it.
    pub fn read(
        &self,
        gpu: &OpenDevice,
        slots: &Slots,
        side: usize,
        all: &Cells<R>,
        sink: Sink,
        results: &mut DeviceRun<R>,
    ) -> Result<(), BackendError> {
        let back = &slots.sides[side];
        let view = gpu.view(&back.states_back)?;
        let cells = self.cells.clone();
        outcomes::read(all, cells, self.own.as_ref(), &view, sink)?;
        results.done += self.cells.len();
        drop(view);
        back.states_back.unmap();
        if let Some(events) = &back.events_back {
            let size = self.cells.len() * slots.events_size as usize;
            let view = gpu.view(events)?;
            results.events.extend_from_slice(bytemuck::cast_slice(&view[..size]));
            drop(view);
            events.unmap();
        }
        Ok(())
    }
}
