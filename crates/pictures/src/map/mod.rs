//! A map as it is drawn.

pub mod boundaries;
pub mod figure;
pub mod refined;
pub mod slices;
pub mod spectrum;
pub mod thinned;

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::outcomes::Outcomes;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;

/// A finished sweep in memory.
pub struct Map<'a> {
    /// What was simulated.
    pub scene: &'a Scene,
    /// Its cells.
    pub grid: Grid,
    /// One outcome a cell, in the grid's order.
    pub outcomes: Cow<'a, [Outcome]>,
    /// The requested columns: others are not known.
    pub columns: ColumnSet,
}

impl Map<'_> {
    /// True where the model is too small for what a cell does: its contact force turns tensile, or
    /// it asks for more friction than there is. Of cells of which this is not known it is false.
    pub fn beyond_the_model(&self, cell: usize) -> bool {
        self.outcomes[cell].is_beyond_the_model(self.grid.value(Parameter::Friction, cell))
    }

    /// True where it is known which cells are beyond the model.
    pub fn tells_beyond_the_model(&self) -> bool {
        self.columns.asked().forces
    }

    /// True where a cell is beyond the model.
    pub fn has_beyond_the_model(&self) -> bool {
        (0..self.outcomes.len()).any(|cell| self.beyond_the_model(cell))
    }
}

impl Outcomes for Map<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.outcomes[..].read(cells, columns)
    }
}
