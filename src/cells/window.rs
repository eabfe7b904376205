//! Boxes of a grid's cells, and the combinations of values that some axes have in them.

use super::cell_list::CellList;
use crate::scene::grid::{AXES, Place};
use crate::scene::{Grid, Parameter};

/// Entries from one value of each axis to the next.
pub type Strides = [usize; AXES];

/// The number of entries from the first one to that of a place.
#[inline(always)]
pub fn offset(strides: &Strides, place: &Place) -> usize {
    strides.iter().zip(place).map(|(stride, at)| stride * at).sum()
}

/// A box of cells of a grid: the first value of each axis, and the number of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    first: Place,
    counts: Place,
}

impl Window {
    /// The whole grid.
    pub fn whole(grid: &Grid) -> Window {
        let mut counts = [1; AXES];
        for (count, axis) in counts.iter_mut().zip(grid.axes()) {
            *count = axis.count();
        }
        Window { first: [0; AXES], counts }
    }

    /// A box around some cells: all values of the fast axes, and of the slow axes only the range that the cells have.
    pub fn around(grid: &Grid, cells: CellList) -> Window {
        let mut window = Window::whole(grid);
        let [low, high] = cells.ends().map(|cell| grid.place(cell));
        for axis in (0..grid.axes().len()).rev() {
            (window.first[axis], window.counts[axis]) = (low[axis], high[axis] - low[axis] + 1);
            if low[axis] != high[axis] {
                break;
            }
        }
        window
    }

    /// The number of cells in it, limited to the range of addresses of the machine.
    pub fn cells(&self) -> usize {
        product(&self.counts)
    }

    /// The combinations of these parameters' values in it.
    pub fn combinations(&self, grid: &Grid, parameters: &[Parameter]) -> Combinations {
        // An axis of another parameter has one value.
        let mut counts = [1; AXES];
        for ((count, axis), whole) in counts.iter_mut().zip(grid.axes()).zip(self.counts) {
            *count = if parameters.contains(&axis.parameter) { whole } else { 1 };
        }
        Combinations { first: self.first, counts }
    }
}

/// All combinations of the values that some axes have in a window: number 0 is that of its first values, and the
/// first axis is the fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Combinations {
    first: Place,
    counts: Place,
}

impl Combinations {
    /// The number of combinations, limited to the range of addresses of the machine.
    pub fn count(&self) -> usize {
        product(&self.counts)
    }

    /// The distance from a value of each axis to the next: zero along an axis without an effect.
    pub fn strides(&self) -> Strides {
        let mut combinations = 1_usize;
        self.counts.map(|count| {
            let stride = if count > 1 { combinations } else { 0 };
            combinations = combinations.saturating_mul(count);
            stride
        })
    }

    /// The distance from the combination of the first values of the grid to that of the window.
    pub fn before(&self) -> usize {
        offset(&self.strides(), &self.first)
    }

    /// The place of a combination.
    pub fn place(&self, number: usize) -> Place {
        let mut rest = number;
        std::array::from_fn(|axis| {
            let at = self.first[axis] + rest % self.counts[axis];
            rest /= self.counts[axis];
            at
        })
    }
}

fn product(counts: &Place) -> usize {
    counts.iter().fold(1, |product, count| product.saturating_mul(*count))
}
