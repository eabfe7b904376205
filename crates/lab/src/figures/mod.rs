//! Figures: several maps side by side, as a paper has them, and what is read off them.
//!
//! A figure is written as TOML ([`text`]): what its panels share, and what each changes. Its
//! motions are records by name, looked for in the user's directory ([`motions`]).

pub mod animation;
pub mod bisection;
pub mod boundary;
pub mod curves;
pub mod error;
pub(crate) mod layout;
pub mod marks;
pub mod motions;
pub mod panels;
pub(crate) mod parameters;
pub mod path;
pub mod shares;
pub mod text;

use serde::Deserialize;

use marks::{Path, Point, Window};
use topple::scene::{Grid, Scene};

/// What the panels of a figure show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shows {
    /// Outcomes by colour, as Figs. 11-14 of the paper.
    Outcomes,
    /// Overturning by the parity of its impacts.
    Parity,
    /// The rocking index in greys, as Figs. 4, 5 and 7-9.
    Rocking,
    /// max|u|, as Fig. 6(a).
    DisplacementU,
    /// max|v|, as Fig. 6(b).
    DisplacementV,
    /// No map: the least amplitude that overturns, against the pulse's frequency.
    LeastAmplitude,
    /// No map: the share of each outcome in the plane, against the eccentricity.
    Shares,
    /// No map: the motion of single cells, animated.
    Motion,
}

impl Shows {
    /// What it can share a figure with: maps are one family, each of the others its own.
    fn family(self) -> Option<Shows> {
        match self {
            Shows::LeastAmplitude | Shows::Shares | Shows::Motion => Some(self),
            _ => None,
        }
    }
}

/// A checked figure.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Name of its files: `fig11`.
    pub name: String,
    /// Title.
    pub title: String,
    /// Panels in a row.
    pub columns: usize,
    /// Row by row from the upper left.
    pub panels: Vec<Panel>,
}

impl Figure {
    /// Cells of all its panels.
    pub fn cells(&self) -> usize {
        self.panels.iter().map(|panel| Grid::of(&panel.scene).len()).sum()
    }
}

/// A panel of a figure.
#[derive(Debug, Clone)]
pub struct Panel {
    /// What it shows.
    pub shows: Shows,
    /// What is simulated.
    pub scene: Scene,
    /// Short name of its motion, if a record shakes it.
    pub motion: Option<String>,
    /// What sets it apart, beside what its scene tells.
    pub label: Option<String>,
    /// Steps of exactly so many seconds, however badly they resolve the motion: to show what
    /// breaks. Else a sweep chooses its steps.
    pub fixed_step: Option<f64>,
    /// A dashed window that another figure enlarges.
    pub window: Option<Window>,
    /// Points that the text speaks of.
    pub points: Vec<Point>,
    /// Paths along which the text follows the outcomes.
    pub paths: Vec<Path>,
    /// Cells whose motion is shown, (x, y).
    pub cells: Vec<marks::Cell>,
    /// Values of the eccentricity along which shares are taken.
    pub eccentricities: Option<topple::scene::Values>,
}

/// The letter of a panel, from a; after z aa, ab and so on.
pub fn letter(index: usize) -> String {
    let letter = |k: usize| char::from(b'a' + (k % 26) as u8);
    if index < 26 {
        return letter(index).to_string();
    }
    format!("{}{}", letter(index / 26 - 1), letter(index))
}
