//! The least amplitude that overturns, against the pulse's frequency.
//!
//! A sweep finds the lowest cell of each frequency that overturns; the reference bisects between it
//! and the cell below. Overturning is no monotonic matter: a region thinner than the sweep's
//! spacing, below the first that the sweep meets, stays unseen.

use std::io::Write;

use rayon::prelude::*;

use super::marks::along;
use crate::results::csv::Number;
use crate::scene::{Directions, Grid, Scene};
use crate::stepping::outcome::Outcome;
use crate::stepping::reference::{self, Settings};

/// Width to which an amplitude is bisected, m/s^2.
pub const WITHIN: f64 = 1.0e-4;

/// The boundary at one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Least {
    /// Omega, rad/s.
    pub omega: f64,
    /// The least A_h that overturns, m/s^2, to within [`WITHIN`]; none where no cell does.
    pub a_h: Option<f64>,
    /// The outcome just above it, by the reference.
    pub outcome: Option<Outcome>,
}

/// The same scene with the block on the ground.
pub fn without_isolation(scene: &Scene) -> Scene {
    scene.clone().isolated(Directions::None)
}

/// The boundary of a swept map, a value a column.
pub fn least(scene: &Scene, outcomes: &[Outcome]) -> Vec<Least> {
    let grid = Grid::of(scene);
    let (columns, rows) = grid.shape();
    let column = |i: usize| {
        let omega = grid.x().values.value(i);
        let amplitude = |j: usize| grid.y().map_or(0.0, |axis| axis.values.value(j));
        let first = (0..rows).find(|&j| outcomes[j * columns + i].class.overturned());
        let Some(first) = first else { return Least { omega, a_h: None, outcome: None } };
        let judge = |a_h: f64| {
            let scene = along(scene, omega, a_h)?;
            Some(reference::run(&scene, &scene.case(), &Settings::default()))
        };
        bisect(omega, if first == 0 { 0.0 } else { amplitude(first - 1) }, amplitude(first), judge)
    };
    (0..columns).into_par_iter().map(column).collect()
}

/// Bisects between an amplitude that stands and one that overturns. Where the reference finds the
/// lower one overturned, or the upper one standing, that end is the answer as far as it goes.
fn bisect(omega: f64, stands: f64, falls: f64, judge: impl Fn(f64) -> Option<Outcome>) -> Least {
    let (mut low, mut high) = (stands, falls);
    let mut outcome = judge(high).filter(|cell| cell.class.overturned());
    while high - low > WITHIN {
        let middle = 0.5 * (low + high);
        match judge(middle) {
            Some(cell) if cell.class.overturned() => (high, outcome) = (middle, Some(cell)),
            _ => low = middle,
        }
    }
    Least { omega, a_h: Some(high), outcome }
}

/// Writes boundaries: a row a frequency, with and without isolation.
///
/// # Errors
/// Those of the writer.
pub fn write(isolated: &[Least], free: &[Least], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record([
        "omega",
        "a_h_isolated",
        "outcome_isolated",
        "impacts_isolated",
        "a_h_free",
        "outcome_free",
        "impacts_free",
    ])?;
    let told = |least: &Least| {
        let name = least.outcome.map(|cell| cell.class.name());
        (least.a_h.map(Number), name, least.outcome.map(|cell| cell.impacts))
    };
    for (with, without) in isolated.iter().zip(free) {
        table.serialize((Number(with.omega), told(with), told(without)))?;
    }
    table.flush()?;
    Ok(())
}
