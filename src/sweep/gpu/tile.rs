//! The description of a tile for the device: the places of its cells and of their numbers. The device
//! makes the cells themselves, by `shaders/begin.wgsl`.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::super::cell_tables::{CellTables, Clocks, OwnClock, Parts};
use super::super::clock::Clock;
use super::super::groups::Steps;
use super::super::table::Strides;
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
    /// Column of the first cell.
    pub first_column: u32,
    /// Row of the first cell.
    pub first_row: u32,
    /// [`IN_ORDER`], [`IN_BLOCKS`] or [`LISTED`].
    pub order: u32,
    /// Blocks in a row of the grid; for [`LISTED`] the place in `words` of the first cell's column.
    pub blocks: u32,
    /// The tile's first slot.
    pub first_slot: u32,
    /// Slots of all tiles.
    pub slots: u32,
    /// Number of the chunk that is to run the cells first.
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
    /// That of entries of so many numbers each, from a place on, of which those `before` a window are
    /// missing.
    pub fn of(strides: Strides, before: usize, first: usize, size: usize) -> Layout {
        // The numbers of a buffer fit in a u32; what lies before its first one wraps round.
        Layout {
            first: (first as u32).wrapping_sub((before * size) as u32),
            strides: strides.map(|stride| (stride * size) as u32),
            more: 0,
        }
    }
}

/// Cells follow one another in the grid, and threads take them so.
pub const IN_ORDER: u32 = 0;
/// Cells follow one another, and threads take them in blocks.
pub const IN_BLOCKS: u32 = 1;
/// Each cell's column and row stand in a list.
pub const LISTED: u32 = 2;

/// Columns of a block of cells: those of a warp are near neighbours, which do much the same.
pub const BLOCK_WIDTH: usize = 8;
/// Rows of a block.
pub const BLOCK_HEIGHT: usize = 4;

impl Tile {
    /// Puts cells of a grid of so many columns in the tile; the threads that make them, and the list
    /// of their columns and rows for those that do not follow one another, which begins at `listed`
    /// in `words`.
    pub fn place(&mut self, columns: usize, cells: &[usize], listed: usize) -> (usize, Vec<u32>) {
        let first = cells.first().copied().unwrap_or(0);
        // A grid has fewer than 2^32 columns and rows, a tile fewer than 2^32 cells.
        let of = |cell: usize| [(cell % columns) as u32, (cell / columns) as u32];
        self.cells = cells.len() as u32;
        self.columns = columns as u32;
        [self.first_column, self.first_row] = of(first);
        if !cells.windows(2).all(|pair| pair[1] == pair[0] + 1) {
            (self.order, self.blocks) = (LISTED, listed as u32);
            return (cells.len(), cells.iter().flat_map(|&cell| of(cell)).collect());
        }
        let blocks = columns.div_ceil(BLOCK_WIDTH);
        let rows = (first % columns + cells.len()).div_ceil(columns);
        let threads = rows.div_ceil(BLOCK_HEIGHT) * blocks * BLOCK_HEIGHT * BLOCK_WIDTH;
        // Blocks that are mostly beside the grid, or before or after the cells, are not worth it.
        if threads <= 2 * cells.len() {
            (self.order, self.blocks) = (IN_BLOCKS, blocks as u32);
            return (threads, Vec::new());
        }
        (self.order, self.blocks) = (IN_ORDER, 0);
        (cells.len(), Vec::new())
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
const CHUNK: usize = 1 << 12;
/// Clocks that are known again; one that is forgotten is listed once more.
const REMEMBERED: usize = 256;

impl<R: Real> OwnClocks<R> {
    /// Those of a tile's cells; none where the tables hold them.
    pub fn of(tables: &CellTables<R>, cells: &[usize]) -> Option<OwnClocks<R>> {
        let Clocks::Own(parts) = &tables.clocks else { return None };
        let mut numbers = vec![0; cells.len()];
        let chunks = numbers.par_chunks_mut(CHUNK).zip(cells.par_chunks(CHUNK));
        let lists: Vec<Vec<OwnClock>> =
            chunks.map(|(numbers, cells)| list(tables, parts, cells, numbers)).collect();
        let firsts: Vec<u32> = lists
            .iter()
            .scan(0, |first, list| Some(std::mem::replace(first, *first + list.len() as u32)))
            .collect();
        let chunks = numbers.par_chunks_mut(CHUNK).zip(&firsts);
        chunks.for_each(|(numbers, first)| numbers.iter_mut().for_each(|number| *number += first));
        let (clocks, steps) =
            lists.par_iter().flatten_iter().map(|listed| (listed.clock, listed.steps())).unzip();
        Some(OwnClocks { numbers, clocks, steps })
    }
}

/// Lists the clocks of some cells, and numbers them.
fn list<R: Real>(
    tables: &CellTables<R>,
    parts: &Parts,
    cells: &[usize],
    numbers: &mut [u32],
) -> Vec<OwnClock> {
    let mut listed: Vec<OwnClock> = Vec::new();
    let mut remembered = [0_u32; REMEMBERED];
    for (number, &cell) in numbers.iter_mut().zip(cells) {
        let this = tables.own_clock(parts, &tables.place(cell));
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
