//! Outcomes over a grid, and the files that hold them.

pub mod boundaries;
pub mod csv;
pub mod figure;
pub mod files;
pub mod history;
pub mod manifest;
pub mod npz;
pub mod outcomes;

use std::borrow::Cow;

use crate::scene::{Grid, Scene};
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

impl Map<'_> {
    /// True where the model is too small for what the cell does: its contact force turns tensile, or
    /// it asks for more friction than there is.
    pub fn beyond_the_model(&self, outcome: &Outcome) -> bool {
        outcome.min_contact < 0.0 || self.slides(outcome)
    }

    /// True where the scene has a friction coefficient and the cell asks for more.
    pub fn slides(&self, outcome: &Outcome) -> bool {
        self.scene.friction.is_some_and(|mu| outcome.friction > mu)
    }
}
