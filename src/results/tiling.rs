//! How a grid is cut into tiles: blocks of cells that lie one after the other, the chunks of its arrays on
//! disk.

use std::ops::Range;

use crate::scene::Grid;
use crate::scene::grid::Axis;

/// Least and most cells of a tile.
const CELLS: [usize; 2] = [1 << 16, 1 << 20];
/// Tiles that a large grid has, about.
const TILES: usize = 256;

/// The tiles of a grid. It depends on nothing but the grid, so that runs on several machines have the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tiling {
    /// Points of the axes, the last one fastest.
    shape: Vec<usize>,
    /// Cells that share the indices up to the one that is cut.
    inner: usize,
    /// Points of the axis that is cut, and those of them that a tile has.
    cut: (usize, usize),
    /// Place of that axis in the shape.
    place: usize,
}

impl Tiling {
    /// The tiling of a grid.
    pub fn of(grid: &Grid) -> Tiling {
        Tiling::large_enough(grid.axes().iter().rev().map(Axis::count).collect(), grid.len())
    }

    /// The tiling of a list of so many cells.
    pub fn of_list(cells: usize) -> Tiling {
        Tiling::large_enough(vec![cells], cells)
    }

    /// The tiling of an array of a shape and so many cells, in about as many tiles as a large one is to have.
    fn large_enough(shape: Vec<usize>, cells: usize) -> Tiling {
        Tiling::with(shape, (cells / TILES).clamp(CELLS[0], CELLS[1]))
    }

    /// The grid as one tile.
    pub fn whole(grid: &Grid) -> Tiling {
        Tiling::with(grid.axes().iter().rev().map(Axis::count).collect(), usize::MAX)
    }

    /// The tiling of an array of a shape in tiles of so many cells at most.
    pub fn with(mut shape: Vec<usize>, most: usize) -> Tiling {
        if shape.is_empty() {
            shape.push(1);
        }
        // Whole axes, from the fastest on, as long as they fit.
        let (mut place, mut inner) = (shape.len() - 1, 1);
        while place > 0 && inner * shape[place] <= most {
            inner *= shape[place];
            place -= 1;
        }
        let cut = (shape[place], (most / inner).clamp(1, shape[place].max(1)));
        Tiling { shape, inner, cut, place }
    }

    /// Points of the axes, the last one fastest.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Points of a whole tile along each axis.
    pub fn tile_shape(&self) -> Vec<usize> {
        let sizes =
            self.shape.iter().enumerate().map(|(place, &count)| match place.cmp(&self.place) {
                std::cmp::Ordering::Less => 1,
                std::cmp::Ordering::Equal => self.cut.1,
                std::cmp::Ordering::Greater => count,
            });
        sizes.collect()
    }

    /// Cells of a whole tile.
    pub fn tile_cells(&self) -> usize {
        self.cut.1 * self.inner
    }

    /// Tiles along the axis that is cut.
    fn across(&self) -> usize {
        self.cut.0.div_ceil(self.cut.1)
    }

    /// Number of tiles.
    pub fn count(&self) -> usize {
        self.shape[..self.place].iter().product::<usize>() * self.across()
    }

    /// The cells of a tile.
    pub fn cells(&self, tile: usize) -> Range<usize> {
        let (slab, k) = (tile / self.across(), tile % self.across());
        let row = |k: usize| slab * self.cut.0 + (k * self.cut.1).min(self.cut.0);
        row(k) * self.inner..row(k + 1) * self.inner
    }

    /// The tile that holds a cell.
    pub fn tile_of(&self, cell: usize) -> usize {
        let row = cell / self.inner;
        row / self.cut.0 * self.across() + row % self.cut.0 / self.cut.1
    }

    /// The tiles that hold some cells.
    pub fn tiles(&self, cells: &Range<usize>) -> Range<usize> {
        if cells.is_empty() {
            return 0..0;
        }
        self.tile_of(cells.start)..self.tile_of(cells.end - 1) + 1
    }

    /// A tile's index along each axis, as in the name of its file: `3/0`.
    pub fn key(&self, tile: usize) -> String {
        let mut rest = tile / self.across();
        let mut index = vec![0; self.shape.len()];
        index[self.place] = tile % self.across();
        for place in (0..self.place).rev() {
            index[place] = rest % self.shape[place];
            rest /= self.shape[place];
        }
        let index: Vec<String> = index.iter().map(usize::to_string).collect();
        index.join("/")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_hold_every_cell_once_in_order() {
        for (shape, most) in [
            (vec![7, 5], 10),
            (vec![7, 5], 3),
            (vec![7, 5], 100),
            (vec![3, 4, 5], 20),
            (vec![3, 4, 5], 10),
            (vec![3, 4, 5], 2),
            (vec![2, 1, 3, 4], 12),
            (vec![9], 4),
            (vec![], 4),
        ] {
            let tiling = Tiling::with(shape, most);
            let mut next = 0;
            for tile in 0..tiling.count() {
                let cells = tiling.cells(tile);
                assert_eq!(cells.start, next, "{tiling:?}");
                assert!(!cells.is_empty() && cells.len() <= most.min(tiling.tile_cells()));
                assert!(cells.clone().all(|cell| tiling.tile_of(cell) == tile), "{tiling:?}");
                next = cells.end;
            }
            assert_eq!(next, tiling.shape().iter().product::<usize>());
            assert_eq!(tiling.tile_cells(), tiling.tile_shape().iter().product::<usize>());
        }
    }

    /// A file's name is the place of the tile's first cell in units of the tile.
    #[test]
    fn a_tile_is_named_by_its_place() {
        let tiling = Tiling::with(vec![3, 4, 5], 10);
        assert_eq!(tiling.tile_shape(), [1, 2, 5]);
        let keys: Vec<String> = (0..tiling.count()).map(|tile| tiling.key(tile)).collect();
        assert_eq!(keys, ["0/0/0", "0/1/0", "1/0/0", "1/1/0", "2/0/0", "2/1/0"]);
        assert_eq!(tiling.tiles(&(9..31)), 0..4);
    }
}
