//! Tables of numbers that depend on only some of the axes of a grid.
//!
//! A group of the numbers of a cell depends on only some of the axes: under a pulse the steps depend on Omega, the
//! yield displacement on A_h. A table has one entry for each combination of the values of those axes, so that a map
//! of a thousand columns and rows needs a few thousand entries for its million cells. It has only the entries that
//! some cells need, so that a batch or a list of cells needs a small table, whatever the size of the grid.

use super::listing::{CellAt, Index, Listing};
use crate::scene::{Case, Parameter};
use crate::work::parallel;

/// The number of entries that a thread computes at once: an entry is some dozens of operations, so that fewer entries do not pay for
/// another thread.
const AT_ONCE: usize = 1 << 8;

/// One entry for each combination of values that a group depends on.
#[derive(Debug, Clone)]
pub struct Table<T> {
    /// The entries, the first axis fastest.
    pub entries: Vec<T>,
    /// Where cells find their entries.
    pub index: Index,
}

impl<T: Send> Table<T> {
    /// The table of a group that depends on these parameters, for the cells of a list.
    pub fn of(
        list: &Listing,
        parameters: &[Parameter],
        entry: impl Fn(&Case) -> T + Sync,
    ) -> Table<T> {
        let known = list.entries(parameters);
        let (entries, index) = &*known;
        let (grid, count) = (list.grid(), entries.count());
        let entry = |number| entry(&grid.case_at(&entries.place(number)));
        Table { entries: parallel::each(count, AT_ONCE, entry), index: index.clone() }
    }
}

impl<T> Table<T> {
    /// The entry of a cell.
    #[inline(always)]
    pub fn at(&self, cell: &CellAt) -> &T {
        &self.entries[self.index.of(cell)]
    }
}
