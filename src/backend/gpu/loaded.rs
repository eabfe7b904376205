//! A tile on the device, from the submission that makes its cells to their outcomes.

use std::ops::Range;

use super::device::OpenDevice;
use super::outcomes::DeviceOutcomes;
use super::slots::Slots;
use super::tile::OwnClocks;
use super::{BackendError, outcomes};
use crate::cells::ready::Cells;
use crate::model::real::Real;

/// Cells on the device.
pub struct LoadedTile<R> {
    /// Number of the tile.
    pub number: usize,
    /// Its cells, by their numbers in the list.
    pub cells: Range<usize>,
    /// Their clocks, where they have each their own.
    pub own: Option<OwnClocks<R>>,
    /// Steps of its longest cell.
    pub longest: u32,
    /// Turns that its cells were given so far.
    pub work: u64,
    /// Number of the submission that makes the cells.
    pub since: usize,
    /// Cells that still run.
    pub left: usize,
    /// Its last states are where the host can read them.
    pub mapped: bool,
}

impl<R: Real> LoadedTile<R> {
    /// Cells that are done, those that run by the share of their steps. A step takes a turn or more,
    /// so that this is an upper bound.
    pub fn done(&self) -> usize {
        let left = self.left.min(self.cells.len());
        let share = (self.work as f64 / f64::from(self.longest.max(1))).min(0.99);
        self.cells.len() - left + (share * left as f64) as usize
    }

    /// Adds what became of its cells, whose last states are mapped, to that of the tiles before it.
    pub fn read(
        &self,
        gpu: &OpenDevice,
        slots: &Slots,
        side: usize,
        all: &Cells<R>,
        results: &mut DeviceOutcomes<R>,
    ) -> Result<(), BackendError> {
        let back = &slots.sides[side];
        let view = gpu.view(&back.states_back)?;
        let cells = self.cells.clone();
        outcomes::read(all, cells, self.own.as_ref(), &view, &mut results.block)?;
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
