//! The description of a tile for the device: the places of its cells and of their numbers. The device
//! makes the cells themselves, by `shaders/begin.wgsl`.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use crate::cells::cell_list::CellList;
use crate::cells::cell_tables::{CellTables, ClockParts, Clocks, OwnClock};
use crate::cells::clock::Clock;
use crate::cells::listing::Index;
use crate::model::excitation::Steps;
use crate::model::real::Real;
use crate::scene::grid::AXES;
use crate::work::parallel;

/// A tile in the form in which the shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Tile {
    /// The layout of the table of horizontal isolations in `numbers`.
    pub horizontal: Layout,
    /// The layout of the table of vertical isolations, likewise.
    pub vertical: Layout,
    /// The layout of the table of excitations, likewise.
    pub drive: Layout,
    /// The layout of the clocks in `clocks`; `more` is 1 where each cell has the number of its clock in `words`.
    pub clock: Layout,
    /// The layout of the bodies, by number.
    pub bodies: Layout,
    /// The layout of the beginnings of motions of u in `words`; `more` is the number of samples of all motions.
    pub across: Layout,
    /// The layout of the motions of v, likewise.
    pub up: Layout,
    /// The number of values of each axis after the first except the last; 1 for an axis that the grid does not have.
    pub counts: [u32; 4],
    /// The place in `numbers` of the height and the lever arms of the first body.
    pub levers: u32,
    /// The place of the vertical motions in `motions`.
    pub up_values: u32,
    /// 1 where there are shared motions.
    pub shared_contact: u32,
    /// 1 where the base does not move vertically before the block lifts.
    pub still: u32,
    /// The number of cells of the tile.
    pub cells: u32,
    /// The number of columns of the grid.
    pub columns: u32,
    /// The column of the first cell; 0 for a list.
    pub first_column: u32,
    /// The row of the first cell; 0 for a list.
    pub first_row: u32,
    /// [`IN_ORDER`] or [`LISTED`].
    pub order: u32,
    /// For [`LISTED`] the place in `words` of the places of the first cell.
    pub listed: u32,
    /// The first slot of the tile.
    pub first_slot: u32,
    /// The number of slots of all tiles.
    pub slots: u32,
    /// The number of the dispatch that first runs the cells.
    pub number: u32,
    /// Padding: the size of the struct is a multiple of 16 bytes.
    pub padding_0: u32,
    /// Padding, as above.
    pub padding_1: u32,
    /// Padding, as above.
    pub padding_2: u32,
}

/// The layout of the entries of a table.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Layout {
    /// The place of the entry of a cell at the start of every axis, modulo 2^32: it may lie before the first entry of
    /// a window.
    pub first: u32,
    /// The distance between two values of each axis.
    pub strides: [u32; AXES],
    /// See the field of [`Tile`].
    pub more: u32,
}

impl Layout {
    /// The layout of entries of a given count of numbers, from a place on, which cells find by their places; none
    /// where cells do not.
    pub fn by_place(index: &Index, first: usize, size: usize) -> Option<Layout> {
        let Index::ByPlace(strides, before) = index else { return None };
        // The places in a buffer fit in a u32; a place before the first one wraps around, and so does a stride beyond
        // the last.
        let word = |entries: usize| entries.wrapping_mul(size) as u32;
        let first = (first as u32).wrapping_sub(word(*before));
        Some(Layout { first, strides: strides.map(word), more: 0 })
    }

    /// The layout of entries of a given count of numbers, from a place on; the number of an entry is the place of a
    /// listed cell along an axis.
    pub fn by_number(axis: usize, first: usize, size: usize) -> Layout {
        let mut layout = Layout { first: first as u32, ..Layout::default() };
        layout.strides[axis] = size as u32;
        layout
    }
}

/// The cells follow one another in the grid, and threads take them in this order.
pub const IN_ORDER: u32 = 0;
/// A list holds the places of each cell along all axes; [in this list](super::listed) they are numbers of entries.
pub const LISTED: u32 = 1;

impl Tile {
    /// Puts cells that follow one another in a grid with a given number of columns in the tile; none where the cells do
    /// not follow one another, and where the device cannot count so many rows.
    pub fn place(&mut self, columns: usize, cells: CellList) -> Option<()> {
        let first = cells.first_of_consecutive()?;
        let (first_column, first_row) = (first % columns, first / columns);
        let rows = (first_column + cells.len()).div_ceil(columns);
        // A thread counts cells from the start of the first row on, and rows.
        let counts = [first_column + cells.len(), first_row + rows];
        if counts.iter().any(|count| u32::try_from(*count).is_err()) {
            return None;
        }
        self.cells = cells.len() as u32;
        // An axis has fewer than 2^32 values.
        self.columns = columns as u32;
        (self.first_column, self.first_row) = (first_column as u32, first_row as u32);
        (self.order, self.listed) = (IN_ORDER, 0);
        Some(())
    }
}

/// The clocks of a tile whose cells have their own clocks: a list of clocks, and the number of each cell in it.
pub struct OwnClocks<R> {
    /// The number of the clock of each cell.
    pub numbers: Vec<u32>,
    /// The clocks, for the host.
    pub clocks: Vec<Clock>,
    /// The numbers of their steps, for the device.
    pub steps: Vec<Steps<R>>,
}

/// The number of cells whose clocks are listed together: in smaller groups the same clock would be listed more often.
const TOGETHER: usize = 1 << 12;
/// The number of clocks that are remembered; a clock that is forgotten is listed again.
const REMEMBERED: usize = 256;

impl<R: Real> OwnClocks<R> {
    /// The clocks of the cells of a tile, by their numbers in the list of the tables; none where the tables hold the
    /// clocks.
    pub fn of(tables: &CellTables<R>, cells: Range<usize>) -> Option<OwnClocks<R>> {
        let Clocks::Own(parts) = &tables.clocks else { return None };
        let mut numbers = vec![0; cells.len()];
        let lists = parallel::each_slice(&mut numbers, TOGETHER, |group, numbers| {
            let listed = list(tables, parts, cells.start + group * TOGETHER, numbers);
            listed.iter().map(|own| (own.clock, own.steps())).collect::<(Vec<_>, Vec<_>)>()
        });
        let (mut clocks, mut steps) = (Vec::new(), Vec::new());
        for (numbers, listed) in numbers.chunks_mut(TOGETHER).zip(lists) {
            let first = clocks.len() as u32;
            numbers.iter_mut().for_each(|number| *number += first);
            clocks.extend(listed.0);
            steps.extend(listed.1);
        }
        Some(OwnClocks { numbers, clocks, steps })
    }
}

/// Lists the clocks of some cells, from a given one on, and numbers them.
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

    /// A device counts rows up to 2^32: it is given no row beyond that, because the count would wrap around.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn no_row_is_cut() {
        let (columns, rows) = (3, 1 << 32);
        let placed = |first: usize, count: usize| {
            let mut tile = Tile::default();
            tile.place(columns, (first..first + count).into())
                .map(|_| [tile.first_column, tile.first_row])
        };
        assert_eq!(placed(columns * (rows - 3) + 1, 4), Some([1, u32::MAX - 2]));
        for (first, count) in [(rows - 3, 10), (rows - 1, 4), (rows, 1), (rows + 5, 40)] {
            assert_eq!(placed(columns * first, count), None, "from row {first} on");
        }
        // The device cannot count beyond the end of a row of nearly as many columns, either.
        let columns = (1 << 32) - 1;
        assert_eq!(Tile::default().place(columns, (columns - 1..columns + 1).into()), None);
    }
}
