//! Outcomes over a grid, and the files that hold them.

pub mod boundaries;
pub mod csv;
pub mod figure;
pub mod files;
pub mod history;
pub mod manifest;
pub mod npz;

use crate::integrate::outcome::{Class, Outcome};
use crate::scene::{Grid, Scene};

/// A finished sweep.
pub struct Map<'a> {
    /// What was simulated.
    pub scene: &'a Scene,
    /// Its cells.
    pub grid: Grid,
    /// One outcome a cell, in the grid's order.
    pub outcomes: Vec<Outcome>,
}

impl Map<'_> {
    /// Number of cells of a class.
    pub fn count(&self, class: Class) -> usize {
        self.outcomes.iter().filter(|outcome| outcome.class == class).count()
    }

    /// True where the model is too small for what the cell does: its contact force turns tensile, or
    /// it asks for more friction than there is.
    pub fn beyond_the_model(&self, outcome: &Outcome) -> bool {
        outcome.min_contact < 0.0 || self.slides(outcome)
    }

    /// True where the scene has a friction coefficient and the cell asks for more.
    pub fn slides(&self, outcome: &Outcome) -> bool {
        self.scene.friction.is_some_and(|mu| outcome.friction > mu)
    }

    /// Number of cells that ask for more friction than the scene has; none where it has none.
    pub fn sliding(&self) -> Option<usize> {
        self.scene.friction?;
        Some(self.outcomes.iter().filter(|outcome| self.slides(outcome)).count())
    }

    /// Number of cells in which the contact force turned tensile, where the model does not hold.
    pub fn tensile(&self) -> usize {
        self.outcomes.iter().filter(|outcome| outcome.min_contact < 0.0).count()
    }
}
