//! What is drawn of a map: all of its cells, or evenly spread ones of a finer grid.

use std::borrow::Cow;
use std::io;

use super::Map;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::outcomes::Outcomes;
use topple::scene::values::spread;
use topple::scene::{Grid, Scene};

/// Most cells a side of what is drawn: four times the pixels that a figure has for them.
pub const DRAWN: usize = 2048;

/// A map of a slice, which begins at a cell of the sweep's grid, with at most a given number of cells a side, as of
/// [`DRAWN`] it is drawn: all of its cells, or of a longer side as many evenly spread ones.
pub fn thinned<'a>(
    scene: &'a Scene,
    (grid, first): (&Grid, usize),
    (outcomes, asked): (&'a dyn Outcomes, ColumnSet),
    most: usize,
) -> io::Result<Map<'a>> {
    let (columns, rows) = grid.shape();
    let thin = grid.thinned(most);
    if thin == *grid {
        let outcomes = outcomes.read(first..first + grid.len(), &Column::ALL)?;
        return Ok(Map { scene, grid: thin, outcomes, columns: asked });
    }
    let (across, up) = thin.shape();
    let mut some = Vec::with_capacity(thin.len());
    for j in 0..up {
        let first = first + spread(j, up, rows) * columns;
        let row = outcomes.read(first..first + columns, &Column::ALL)?;
        some.extend((0..across).map(|i| row[spread(i, across, columns)]));
    }
    Ok(Map { scene, grid: thin, outcomes: Cow::Owned(some), columns: asked })
}
