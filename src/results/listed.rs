//! The cells of a file: those of a grid, or some of them in any order, with counts of their own beside the columns. In arrays a
//! list has one index.

use serde_json::{Map, Value, json};

use super::about::{Source, index};
use super::chunking::Chunking;
use crate::scene::Grid;

/// Name of the array of the cells' numbers.
pub const CELL: &str = "cell";
/// What they mean.
pub const CELL_MEANING: &str = "its first cell's number in the grid";

/// The names of the counts that leaves of a refined map have, beside [`CELL`].
pub const COUNTS: [&str; 5] = ["level", "width", "height", "beside", "impacts_differ"];

/// The name of the count `height` where the block's height is an axis, which has that name.
pub const LEAF_HEIGHT: &str = "leaf_height";

/// A count that each of the cells has, such as the width of what it stands for.
#[derive(Debug, Clone)]
pub struct CountColumn {
    /// Its name in files.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// A value a cell.
    pub values: Vec<u32>,
}

/// Some cells of a grid.
#[derive(Clone, Copy)]
pub struct CellList<'a> {
    /// Their numbers in the grid.
    pub cells: &'a [usize],
    /// Counts of their own.
    pub counts: &'a [CountColumn],
    /// What one of them is: the index of their arrays.
    pub index: &'static str,
}

/// The cells of a file: all of a grid in its order, or a list.
#[derive(Clone, Copy)]
pub struct FileCells<'a> {
    /// The grid that numbers them.
    pub grid: &'a Grid,
    /// The list.
    pub list: Option<CellList<'a>>,
}

impl<'a> From<&'a Grid> for FileCells<'a> {
    fn from(grid: &'a Grid) -> FileCells<'a> {
        FileCells { grid, list: None }
    }
}

impl<'a> FileCells<'a> {
    /// The number of cells.
    pub fn count(&self) -> usize {
        self.list.map_or(self.grid.len(), |list| list.cells.len())
    }

    /// The number in the grid of one of them.
    pub fn cell(&self, number: usize) -> usize {
        self.list.map_or(number, |list| list.cells[number])
    }

    /// Their counts.
    pub fn counts(&self) -> &'a [CountColumn] {
        self.list.map_or(&[], |list| list.counts)
    }

    /// The indices of their arrays.
    pub fn index(&self) -> Vec<&'static str> {
        self.list.map_or_else(|| index(self.grid), |list| vec![list.index])
    }

    /// How they are cut into chunks.
    pub fn chunking(&self) -> Chunking {
        self.list
            .map_or_else(|| Chunking::of(self.grid), |list| Chunking::of_list(list.cells.len()))
    }

    /// What their arrays are, as [`Source::about`] tells it, and of a list under `counts` what is beside the columns.
    pub fn about(&self, source: Source) -> Map<String, Value> {
        let mut about = source.about(self.grid);
        if self.list.is_some() {
            let entry = |meaning: &str| json!({ "unit": "", "meaning": meaning });
            let cells = (CELL.to_string(), entry(CELL_MEANING));
            let own = self.counts().iter();
            let own = own.map(|count| (count.name.to_string(), entry(count.meaning)));
            let counts: Map<String, Value> = [cells].into_iter().chain(own).collect();
            about.insert("index".into(), json!(self.index()));
            about.insert("counts".into(), Value::Object(counts));
        }
        about
    }
}
