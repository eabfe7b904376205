//! The description of a tile for the device: the places of its cells and of their numbers. The device
//! makes the cells themselves, by `shaders/begin.wgsl`.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use crate::cells::cell_tables::{CellTables, ClockParts, Clocks, OwnClock};
use crate::cells::clock::Clock;
use crate::cells::groups::Steps;
use crate::cells::listing::Index;
use crate::model::real::Real;
use crate::scene::grid::AXES;

/// A tile as the shader knows it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Tile {
    /// Of the table in `numbers`.
    pub horizontal: Layout,
    /// The same.
    pub vertical: Layout,
    /// The same.
    pub drive: Layout,
    /// The same in `clocks`; `more` is 1 where each cell has the number of its clock in `words`.
    pub clock: Layout,
    /// Of the bodies, by number.
    pub bodies: Layout,
    /// Of the motions' beginnings in `words`; `more` are the samples of all motions.
    pub across: Layout,
    /// The same of the vertical motions.
    pub up: Layout,
    /// Values of the axes after the first but the last, for those that a grid lacks 1.
    pub counts: [u32; 4],
    /// Place in `numbers` of the first body's height and lever arms.
    pub levers: u32,
    /// Place of the vertical motions in `motions`.
    pub up_values: u32,
    /// 1 where there are shared motions.
    pub shared_contact: u32,
    /// 1 where the base does not move vertically before the block lifts.
    pub still: u32,
    /// Cells of the tile.
    pub cells: u32,
    /// Columns of the grid.
    pub columns: u32,
    /// Column of the first cell; of a list 0.
    pub first_column: u32,
    /// Row of the first cell; of a list 0.
    pub first_row: u32,
    /// [`IN_ORDER`], [`IN_BLOCKS`] or [`LISTED`].
    pub order: u32,
    /// Blocks in a row of the grid; for [`LISTED`] the place in `words` of the first cell's places.
    pub blocks: u32,
    /// The tile's first slot.
    pub first_slot: u32,
    /// Slots of all tiles.
    pub slots: u32,
    /// Number of the dispatch that is to run the cells first.
    pub number: u32,
    /// Fills the struct to whole 16 bytes.
    pub padding_0: u32,
    /// The same.
    pub padding_1: u32,
    /// The same.
    pub padding_2: u32,
}

/// Where a table's entries lie.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Layout {
    /// Place of the entry of a cell at the start of every axis, modulo 2^32: it may lie before a window's
    /// first.
    pub first: u32,
    /// From a value of each axis to the next.
    pub strides: [u32; AXES],
    /// See the field of [`Tile`].
    pub more: u32,
}

impl Layout {
    /// That of entries of a given number of numbers each, from a place on, which cells find by their places; none where they do
    /// not.
    pub fn by_place(index: &Index, first: usize, size: usize) -> Option<Layout> {
        let Index::ByPlace(strides, before) = index else { return None };
        // The numbers of a buffer fit in a u32; what lies before its first one wraps round, and so does a stride beyond
        // its last.
        let word = |entries: usize| entries.wrapping_mul(size) as u32;
        let first = (first as u32).wrapping_sub(word(*before));
        Some(Layout { first, strides: strides.map(word), more: 0 })
    }

    /// That of entries of a given number of numbers each, from a place on, whose number is a listed cell's place along an axis.
    pub fn by_number(axis: usize, first: usize, size: usize) -> Layout {
        let mut layout = Layout { first: first as u32, ..Layout::default() };
        layout.strides[axis] = size as u32;
        layout
    }
}

/// Cells follow one another in the grid, and threads take them so.
pub const IN_ORDER: u32 = 0;
/// Cells follow one another, and threads take them in blocks.
pub const IN_BLOCKS: u32 = 1;
/// Each cell's places along all axes stand in a list; [here](super::listed) they are numbers of entries.
pub const LISTED: u32 = 2;

/// Columns of a block of cells: those of a warp are near neighbours, which do much the same.
pub const BLOCK_WIDTH: usize = 8;
/// Rows of a block.
pub const BLOCK_HEIGHT: usize = 4;

impl Tile {
    /// Puts cells that follow one another in a grid of a given number of columns in the tile; the threads that make them. None
    /// where they do not, and where the device cannot count so many rows.
    pub fn place(&mut self, columns: usize, cells: &[usize]) -> Option<usize> {
        let first = cells.first().copied().unwrap_or(0);
        if !cells.windows(2).all(|pair| pair[1] == pair[0] + 1) {
            return None;
        }
        let (first_column, first_row) = (first % columns, first / columns);
        let rows = (first_column + cells.len()).div_ceil(columns);
        // What a thread counts: cells from the first row's start on, and rows.
        let counts = [first_column + cells.len(), first_row + rows];
        if counts.iter().any(|count| u32::try_from(*count).is_err()) {
            return None;
        }
        self.cells = cells.len() as u32;
        // An axis has fewer than 2^32 values.
        self.columns = columns as u32;
        (self.first_column, self.first_row) = (first_column as u32, first_row as u32);
        let blocks = columns.div_ceil(BLOCK_WIDTH);
        let threads = rows.div_ceil(BLOCK_HEIGHT) * blocks * BLOCK_HEIGHT * BLOCK_WIDTH;
        // Blocks that are mostly beside the grid, or before or after the cells, are not worth it.
        if threads <= 2 * cells.len() {
            (self.order, self.blocks) = (IN_BLOCKS, blocks as u32);
            return Some(threads);
        }
        (self.order, self.blocks) = (IN_ORDER, 0);
        Some(cells.len())
    }
}

/// The clocks of a tile whose cells have each their own: a list, and each cell's number in it.
pub struct OwnClocks<R> {
    /// For each cell.
    pub numbers: Vec<u32>,
    /// For the host.
    pub clocks: Vec<Clock>,
    /// For the device.
    pub steps: Vec<Steps<R>>,
}

/// Cells whose clocks are listed together.
const TOGETHER: usize = 1 << 12;
/// Clocks that are known again; one that is forgotten is listed once more.
const REMEMBERED: usize = 256;

impl<R: Real> OwnClocks<R> {
    /// Those of a tile's cells, by their numbers in the tables' list; none where the tables hold them.
    pub fn of(tables: &CellTables<R>, cells: Range<usize>) -> Option<OwnClocks<R>> {
        let Clocks::Own(parts) = &tables.clocks else { return None };
        let mut numbers = vec![0; cells.len()];
        let groups = numbers.par_chunks_mut(TOGETHER).enumerate();
        let first = |group| cells.start + group * TOGETHER;
        let lists: Vec<Vec<OwnClock>> =
            groups.map(|(group, numbers)| list(tables, parts, first(group), numbers)).collect();
        let firsts: Vec<u32> = lists
            .iter()
            .scan(0, |first, list| Some(std::mem::replace(first, *first + list.len() as u32)))
            .collect();
        let groups = numbers.par_chunks_mut(TOGETHER).zip(&firsts);
        groups.for_each(|(numbers, first)| numbers.iter_mut().for_each(|number| *number += first));
        let (clocks, steps) =
            lists.par_iter().flatten_iter().map(|listed| (listed.clock, listed.steps())).unzip();
        Some(OwnClocks { numbers, clocks, steps })
    }
}

/// Lists the clocks of some cells, from one on, and numbers them.
fn list<R: Real>(
    tables: &CellTables<R>,
    parts: &ClockParts,
    first: usize,
    numbers: &mut [u32],
) -> Vec<OwnClock> {
    let mut listed: Vec<OwnClock> = Vec::new();
    let mut remembered = [0_u32; REMEMBERED];
    for (cell, number) in (first..).zip(numbers) {
        let this = tables.own_clock(parts, &tables.cell(cell));
        let clock = this.clock;
        let hash = (clock.steps ^ clock.substeps.rotate_left(16)).wrapping_mul(0x9E37_79B9) >> 24;
        let known = &mut remembered[hash as usize % REMEMBERED];
        if listed.get(*known as usize) != Some(&this) {
            *known = listed.len() as u32;
            listed.push(this);
        }
        *number = *known;
    }
    listed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device counts rows to 2^32: it is given none beyond, which would be others.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn no_row_is_cut() {
        let (columns, rows) = (3, 1 << 32);
        let placed = |first: usize, count: usize| {
            let cells: Vec<usize> = (first..first + count).collect();
            let mut tile = Tile::default();
            tile.place(columns, &cells).map(|_| [tile.first_column, tile.first_row])
        };
        assert_eq!(placed(columns * (rows - 3) + 1, 4), Some([1, u32::MAX - 2]));
        for (first, count) in [(rows - 3, 10), (rows - 1, 4), (rows, 1), (rows + 5, 40)] {
            assert_eq!(placed(columns * first, count), None, "from row {first} on");
        }
        // Nor does it count beyond the end of a row of nearly as many columns.
        let columns = (1 << 32) - 1;
        assert_eq!(Tile::default().place(columns, &[columns - 1, columns]), None);
    }
}
