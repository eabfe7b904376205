//! Tables of numbers that depend on some of a grid's axes only.
//!
//! A group of a cell's numbers depends on some of the axes only: under a pulse the steps on Omega, the
//! yield displacement on A_h. A table has one entry for each combination of the values of those axes,
//! so that a map of a thousand columns and rows needs a few thousand entries for its million cells. It
//! covers a window of the grid, so that a tile of a large grid needs a small one.

use crate::scene::grid::{AXES, Place};
use crate::scene::{Case, Grid, Parameter};

/// Entries from one value of each axis to the next.
pub type Strides = [usize; AXES];

/// Entries from the first to the one of a place.
#[inline(always)]
pub fn offset(strides: &Strides, place: &Place) -> usize {
    strides.iter().zip(place).map(|(stride, at)| stride * at).sum()
}

/// A box of a grid's cells: the first value of each axis, and how many.
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

    /// A box around some cells: all values of the fast axes, and of the slow ones no more than they have.
    pub fn around(grid: &Grid, cells: &[usize]) -> Window {
        let mut window = Window::whole(grid);
        let least = cells.iter().min().copied().unwrap_or(0);
        let most = cells.iter().max().copied().unwrap_or(0);
        let (low, high) = (grid.place(least), grid.place(most));
        for axis in (0..grid.axes().len()).rev() {
            (window.first[axis], window.counts[axis]) = (low[axis], high[axis] - low[axis] + 1);
            if low[axis] != high[axis] {
                break;
            }
        }
        window
    }

    /// Values of each axis that these parameters have in it: one along an axis of another parameter.
    fn counts(&self, grid: &Grid, parameters: &[Parameter]) -> Place {
        let mut counts = [1; AXES];
        for ((count, axis), whole) in counts.iter_mut().zip(grid.axes()).zip(self.counts) {
            *count = if parameters.contains(&axis.parameter) { whole } else { 1 };
        }
        counts
    }

    /// Cells in it.
    pub fn cells(&self) -> usize {
        self.counts.iter().product()
    }

    /// Entries that a table of these parameters has.
    pub fn entries(&self, grid: &Grid, parameters: &[Parameter]) -> usize {
        self.counts(grid, parameters).iter().product()
    }
}

/// One entry for each combination of values that a group depends on.
#[derive(Debug, Clone)]
pub struct Table<T> {
    /// The entries, the first axis fastest.
    pub entries: Vec<T>,
    /// Entries from a value to the next: none along an axis of no effect.
    pub strides: Strides,
    /// Entries before the window.
    pub before: usize,
}

impl<T> Table<T> {
    /// The table of a group that depends on these parameters, of the cells in a window.
    pub fn of(
        grid: &Grid,
        window: &Window,
        parameters: &[Parameter],
        entry: impl Fn(&Case) -> T,
    ) -> Table<T> {
        let (counts, strides) =
            (window.counts(grid, parameters), strides(grid, window, parameters));
        let before = offset(&strides, &window.first);
        let entries = places(window, counts).map(|place| entry(&grid.case_at(&place))).collect();
        Table { entries, strides, before }
    }

    /// The place of a cell's entry.
    #[inline(always)]
    pub fn index(&self, place: &Place) -> usize {
        offset(&self.strides, place) - self.before
    }

    /// The entry of a cell.
    #[inline(always)]
    pub fn at(&self, place: &Place) -> &T {
        &self.entries[self.index(place)]
    }
}

/// The strides of a table of these parameters.
pub fn strides(grid: &Grid, window: &Window, parameters: &[Parameter]) -> Strides {
    let mut strides = [0; AXES];
    let mut entries = 1;
    for (stride, count) in strides.iter_mut().zip(window.counts(grid, parameters)) {
        *stride = if count > 1 { entries } else { 0 };
        entries *= count;
    }
    strides
}

/// The places of a window's entries, so many along each axis.
fn places(window: &Window, counts: Place) -> impl Iterator<Item = Place> + use<> {
    let first = window.first;
    (0..counts.iter().product()).map(move |entry| {
        let mut rest = entry;
        std::array::from_fn(|axis| {
            let at = first[axis] + rest % counts[axis];
            rest /= counts[axis];
            at
        })
    })
}

/// The places of the entries of a table of these parameters over a whole grid.
pub fn places_of(grid: &Grid, parameters: &[Parameter]) -> impl Iterator<Item = Place> + use<> {
    let window = Window::whole(grid);
    places(&window, window.counts(grid, parameters))
}
