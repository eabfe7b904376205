//! Some of a grid's cells, in any order, with counts of their own beside the columns: as a table, and as arrays of one
//! index.

use serde_json::{Map, Value, json};

use super::about::Source;
use super::outcomes::Outcomes;
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

/// Cells of a grid, by their numbers, with their outcomes in the same order.
pub struct ListedCells<'a> {
    /// The grid that numbers them.
    pub grid: &'a Grid,
    /// Their numbers.
    pub cells: &'a [usize],
    /// Counts of their own.
    pub counts: &'a [CountColumn],
    /// Their outcomes: number k is that of the k-th of them.
    pub outcomes: &'a dyn Outcomes,
    /// What one of them is: the index of their arrays.
    pub index: &'static str,
}

impl ListedCells<'_> {
    /// What their arrays are, as [`Source::about`] tells it of a grid's, and under `counts` what is beside the columns.
    pub fn about(&self, source: Source) -> Map<String, Value> {
        let entry = |meaning: &str| json!({ "unit": "", "meaning": meaning });
        let cells = (CELL.to_string(), entry(CELL_MEANING));
        let own = self.counts.iter().map(|count| (count.name.to_string(), entry(count.meaning)));
        let counts: Map<String, Value> = [cells].into_iter().chain(own).collect();
        let mut about = source.about(self.grid);
        about.insert("index".into(), json!([self.index]));
        about.insert("counts".into(), Value::Object(counts));
        about
    }
}
