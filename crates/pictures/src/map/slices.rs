//! The slices of a sweep with more than two axes: a map of the first two each.

use std::io;

use super::Map;
use super::thinned::{DRAWN, thinned};
use crate::drawing::ticks::rounded;
use topple::results::column_set::ColumnSet;
use topple::results::outcomes::Outcomes;
use topple::scene::{Grid, Scene};

/// Most slices that are drawn.
pub const MOST: usize = 24;

/// A slice as it is drawn.
pub struct Slice<'a> {
    /// Its cells.
    pub map: Map<'a>,
    /// The values of the other axes, with symbols and units; empty where there are none.
    pub at: String,
}

/// The slices of a sweep of which some columns were requested, thinned to what is drawn; none where there are more than [`MOST`].
pub fn of<'a>(
    scene: &'a Scene,
    grid: &Grid,
    outcomes: &'a dyn Outcomes,
    asked: ColumnSet,
) -> io::Result<Vec<Slice<'a>>> {
    let count = grid.slices();
    if count > MOST {
        return Ok(Vec::new());
    }
    let area = grid.len() / count;
    (0..count)
        .map(|number| {
            let (slice, fixed) = grid.slice(number);
            let map = thinned(scene, (&slice, number * area), (outcomes, asked), DRAWN)?;
            let at: Vec<String> = fixed
                .iter()
                .map(|(parameter, value)| parameter.entry().written(rounded(*value, value.abs())))
                .collect();
            Ok(Slice { map, at: at.join(", ") })
        })
        .collect()
}
