//! Outcomes over a grid, and the files that hold them.

pub mod boundaries;
pub mod columns;
pub mod csv;
pub mod figure;
pub mod files;
pub mod history;
pub mod manifest;
pub mod npz;
pub mod outcomes;
pub mod slices;

use std::borrow::Cow;

use crate::scene::{Grid, Parameter, Scene};
use crate::stepping::outcome::Outcome;

/// A finished sweep in memory.
pub struct Map<'a> {
    /// What was simulated.
    pub scene: &'a Scene,
    /// Its cells.
    pub grid: Grid,
    /// One outcome a cell, in the grid's order.
    pub outcomes: Cow<'a, [Outcome]>,
}

/// True where a cell of a grid has a friction coefficient and asks for more.
pub fn slides(grid: &Grid, cell: usize, outcome: &Outcome) -> bool {
    let coefficient = grid.value(Parameter::Friction, cell);
    coefficient.is_some_and(|mu| outcome.friction > mu)
}

impl Map<'_> {
    /// True where the model is too small for what a cell does: its contact force turns tensile, or
    /// it asks for more friction than there is.
    pub fn beyond_the_model(&self, cell: usize) -> bool {
        let outcome = &self.outcomes[cell];
        outcome.min_contact < 0.0 || slides(&self.grid, cell, outcome)
    }

    /// True where a cell is beyond the model.
    pub fn has_beyond_the_model(&self) -> bool {
        (0..self.outcomes.len()).any(|cell| self.beyond_the_model(cell))
    }
}
