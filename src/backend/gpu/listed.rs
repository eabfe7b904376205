//! The cells of a tile that do not follow one another in the grid, or whose numbers exceed the range of the device:
//! the host looks up their entries, and the device has the number of each entry.
//!
//! For the device they are the cells of a grid whose axes are the tables: the place of a cell along such an axis is
//! the number of its entry, however large the true grid is.

use std::ops::Range;

use super::tile::{LISTED, Layout, Tile};
use crate::cells::cell_tables::Clocks;
use crate::cells::listing::Index;
use crate::cells::ready::Cells;
use crate::model::excitation::{Drive, Horizontal, Vertical};
use crate::model::real::Real;
use crate::scene::grid::AXES;
use crate::work::parallel;

/// The count of numbers in an entry of each table that an axis stands for: the horizontal and the vertical isolation,
/// the excitation and the bodies; and the beginnings of motions of u and of v.
pub const SIZES: [usize; AXES] =
    [reals::<Horizontal<f32>>(), reals::<Vertical<f32>>(), reals::<Drive<f32>>(), 1, 1, 1];

/// The count of numbers in a group that has only reals.
const fn reals<G>() -> usize {
    size_of::<G>() / size_of::<f32>()
}

/// The beginning of each table.
pub type Firsts = [usize; AXES];

/// The places of some cells along these axes, one cell after another.
pub fn places<R: Real>(all: &Cells<R>, cells: Range<usize>) -> Vec<u32> {
    let tables = &all.tables;
    let of_tables = [&tables.horizontal.index, &tables.vertical.index, &tables.drive.index];
    let of = |number: usize| {
        let cell = tables.cell(number);
        // A list has fewer than 2^32 entries of a table, and fewer motions, too.
        let entry = |index: &Index| index.of(&cell) as u32;
        let [horizontal, vertical, drive] = of_tables.map(entry);
        let [across, up] =
            all.of_motions.as_ref().map_or([0; 2], |of| [entry(&of[0]), entry(&of[1])]);
        [horizontal, vertical, drive, entry(&tables.bodies.index), across, up]
    };
    parallel::each(cells.len(), parallel::LOOKUPS, |number| of(cells.start + number))
        .into_flattened()
}

/// The number of the clock of each cell, where the tables hold the clocks.
pub fn clocks<R: Real>(all: &Cells<R>, cells: Range<usize>) -> Vec<u32> {
    match &all.tables.clocks {
        Clocks::Shared(table) => {
            let of = |number| table.index.of(&all.tables.cell(number)) as u32;
            parallel::each(cells.len(), parallel::LOOKUPS, |number| of(cells.start + number))
        }
        Clocks::Own(_) => Vec::new(),
    }
}

impl Tile {
    /// Describes the tables of cells that find their entries by their places; none where cells find some entries by
    /// their numbers in the list.
    pub fn find_by_place<R>(&mut self, cells: &Cells<R>, firsts: &Firsts) -> Option<()> {
        let tables = &cells.tables;
        let by_place = |table: usize, index| Layout::by_place(index, firsts[table], SIZES[table]);
        self.horizontal = by_place(0, &tables.horizontal.index)?;
        self.vertical = by_place(1, &tables.vertical.index)?;
        self.drive = by_place(2, &tables.drive.index)?;
        self.bodies = by_place(3, &tables.bodies.index)?;
        if let Clocks::Shared(shared) = &tables.clocks {
            self.clock = Layout::by_place(&shared.index, 0, 1)?;
        }
        if let Some([across, up]) = &cells.of_motions {
            self.across = Layout { more: self.across.more, ..by_place(4, across)? };
            self.up = Layout { more: self.up.more, ..by_place(5, up)? };
        }
        Some(())
    }

    /// Makes this the tile of a given number of listed cells, whose places begin at `listed` in `words`.
    pub fn list(&mut self, cells: usize, listed: usize, firsts: &Firsts) {
        // A tile has fewer than 2^32 cells, and a buffer has fewer words.
        (self.cells, self.order, self.listed) = (cells as u32, LISTED, listed as u32);
        (self.columns, self.first_column, self.first_row) = (0, 0, 0);
        let tables = [
            &mut self.horizontal,
            &mut self.vertical,
            &mut self.drive,
            &mut self.bodies,
            &mut self.across,
            &mut self.up,
        ];
        for (axis, layout) in tables.into_iter().enumerate() {
            let more = layout.more;
            *layout = Layout { more, ..Layout::by_number(axis, firsts[axis], SIZES[axis]) };
        }
    }
}
