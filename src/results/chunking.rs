//! How a grid is cut into chunks: cells that lie one after the other and are saved together. They are the chunks of its
//! Zarr arrays, too.

use std::ops::Range;

use crate::scene::Grid;
use crate::scene::grid::Axis;

/// Least and most cells of a chunk.
const CELLS: [usize; 2] = [1 << 16, 1 << 20];
/// Chunks that a large grid has, about.
const COUNT: usize = 256;

/// The chunks of a grid. They depend on nothing but the grid, so that runs on several machines have the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chunking {
    /// Points of the axes, the last one fastest.
    shape: Vec<usize>,
    /// Cells that share the indices up to the one that is cut.
    inner: usize,
    /// Points of the axis that is cut, and those of them that a chunk has.
    cut: (usize, usize),
    /// Place of that axis in the shape.
    place: usize,
}

impl Chunking {
    /// The chunks of a grid.
    pub fn of(grid: &Grid) -> Chunking {
        Chunking::large_enough(grid.axes().iter().rev().map(Axis::count).collect(), grid.len())
    }

    /// The chunks of a list of a given number of cells.
    pub fn of_list(cells: usize) -> Chunking {
        Chunking::large_enough(vec![cells], cells)
    }

    /// The chunks of an array of a shape and so many cells: about as many as a large one is to have.
    fn large_enough(shape: Vec<usize>, cells: usize) -> Chunking {
        Chunking::with(shape, (cells / COUNT).clamp(CELLS[0], CELLS[1]))
    }

    /// The chunks of an array of a shape, of at most a given number of cells.
    pub fn with(mut shape: Vec<usize>, most: usize) -> Chunking {
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
        Chunking { shape, inner, cut, place }
    }

    /// Points of the axes, the last one fastest.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Points of a whole chunk along each axis.
    pub fn chunk_shape(&self) -> Vec<usize> {
        let sizes =
            self.shape.iter().enumerate().map(|(place, &count)| match place.cmp(&self.place) {
                std::cmp::Ordering::Less => 1,
                std::cmp::Ordering::Equal => self.cut.1,
                std::cmp::Ordering::Greater => count,
            });
        sizes.collect()
    }

    /// Cells of a whole chunk.
    pub fn chunk_cells(&self) -> usize {
        self.cut.1 * self.inner
    }

    /// Chunks along the axis that is cut.
    fn across(&self) -> usize {
        self.cut.0.div_ceil(self.cut.1)
    }

    /// Number of chunks.
    pub fn count(&self) -> usize {
        self.shape[..self.place].iter().product::<usize>() * self.across()
    }

    /// The cells of a chunk.
    pub fn cells(&self, chunk: usize) -> Range<usize> {
        let (slab, k) = (chunk / self.across(), chunk % self.across());
        let row = |k: usize| slab * self.cut.0 + (k * self.cut.1).min(self.cut.0);
        row(k) * self.inner..row(k + 1) * self.inner
    }

    /// The chunk that holds a cell.
    pub fn chunk_of(&self, cell: usize) -> usize {
        let row = cell / self.inner;
        row / self.cut.0 * self.across() + row % self.cut.0 / self.cut.1
    }

    /// The chunks that hold some cells.
    pub fn chunks(&self, cells: &Range<usize>) -> Range<usize> {
        if cells.is_empty() {
            return 0..0;
        }
        self.chunk_of(cells.start)..self.chunk_of(cells.end - 1) + 1
    }

    /// A chunk's index along each axis, as in the name of its file: `3/0`.
    pub fn key(&self, chunk: usize) -> String {
        let mut rest = chunk / self.across();
        let mut index = vec![0; self.shape.len()];
        index[self.place] = chunk % self.across();
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
    fn chunks_hold_every_cell_once_in_order() {
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
            let chunking = Chunking::with(shape, most);
            let mut next = 0;
            for chunk in 0..chunking.count() {
                let cells = chunking.cells(chunk);
                assert_eq!(cells.start, next, "{chunking:?}");
                assert!(!cells.is_empty() && cells.len() <= most.min(chunking.chunk_cells()));
                assert!(cells.clone().all(|cell| chunking.chunk_of(cell) == chunk), "{chunking:?}");
                next = cells.end;
            }
            assert_eq!(next, chunking.shape().iter().product::<usize>());
            assert_eq!(chunking.chunk_cells(), chunking.chunk_shape().iter().product::<usize>());
        }
    }

    /// A file's name is the place of the chunk's first cell in units of the chunk.
    #[test]
    fn a_chunk_is_named_by_its_place() {
        let chunking = Chunking::with(vec![3, 4, 5], 10);
        assert_eq!(chunking.chunk_shape(), [1, 2, 5]);
        let keys: Vec<String> = (0..chunking.count()).map(|chunk| chunking.key(chunk)).collect();
        assert_eq!(keys, ["0/0/0", "0/1/0", "1/0/0", "1/1/0", "2/0/0", "2/1/0"]);
        assert_eq!(chunking.chunks(&(9..31)), 0..4);
    }
}
