//! The least amplitude that overturns, against the pulse's frequency.
//!
//! A sweep finds the lowest cell of each frequency that overturns; its own method, in f64, bisects between it and the
//! cell below, at all frequencies at once, and the reference says at some of them how far off that is. Overturning is no
//! monotonic matter: a region thinner than the sweep's spacing, below the first that the sweep meets, stays unseen.

use std::io::Write;

use super::bisection::{Bracket, Curve, CurvePoint, ReferenceWord, WITHIN};
use topple::backend::ready::Backend;
use topple::cells::plan::Plan;
use topple::results::csv::Number;
use topple::scene::{Directions, Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;
use topple::sweep::error::SweepError;
use topple::work::observer::Observer;

/// The boundary at one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Least {
    /// Omega, rad/s.
    pub omega: f64,
    /// The least A_h that overturns, m/s^2, to [`within`] a millionth of the axis; none where no cell does.
    pub a_h: Option<f64>,
    /// The outcome just above it.
    pub outcome: Option<Outcome>,
}

/// The same scene with the block on the ground.
pub fn without_isolation(scene: &Scene) -> Scene {
    scene.clone().isolated(Directions::None)
}

/// How boundaries are bisected: on what, and by which plan of a scene.
#[derive(Clone, Copy)]
pub struct Bisection<'a> {
    /// The backend that runs cells: one, or several GPUs that are alike.
    pub backends: &'a [Backend],
    /// The plan of a scene.
    pub plan: &'a (dyn Fn(&Scene) -> Result<Plan, SweepError> + Sync),
    /// Frequencies at which the reference is asked, too.
    pub asked: usize,
}

/// Width to which the amplitudes of a grid are bisected, m/s^2.
pub fn within(grid: &Grid) -> f64 {
    let (low, high) = grid.y().map_or((0.0, 0.0), |axis| axis.values.ends());
    WITHIN * high.abs().max(high - low)
}

/// The boundary of a swept map, a value a column, and what the reference says of it.
pub fn least(
    scene: &Scene,
    outcomes: &[Outcome],
    bisection: &Bisection,
    observer: &dyn Observer,
) -> Result<(Vec<Least>, ReferenceWord), SweepError> {
    let grid = Grid::of(scene);
    let (columns, rows) = grid.shape();
    let amplitude = |j: usize| grid.y().map_or(0.0, |axis| axis.values.value(j));
    let first = |i: usize| (0..rows).find(|&j| outcomes[j * columns + i].class.overturned());
    let bracket = |i: usize| {
        let first = first(i)?;
        let before = if first == 0 { 0.0 } else { amplitude(first - 1) };
        Some(Bracket { at: grid.x().values.value(i), before, beyond: amplitude(first) })
    };
    let brackets: Vec<Option<Bracket>> = (0..columns).map(bracket).collect();
    let curve = Curve {
        scene,
        parameters: [Parameter::Omega, Parameter::AH],
        is_beyond: &|outcome| outcome.class.overturned(),
        plan: bisection.plan,
        within: within(&grid),
    };
    let known: Vec<Bracket> = brackets.iter().flatten().copied().collect();
    let mut points = curve.points(&known, bisection.backends, observer)?;
    let word = curve.ask_reference(&mut points, bisection.asked, observer)?;
    let mut points = points.into_iter();
    let least = |(i, bracket): (usize, Option<Bracket>)| {
        let omega = grid.x().values.value(i);
        match bracket.and_then(|_| points.next()) {
            Some(CurvePoint { value, outcome, .. }) => Least { omega, a_h: Some(value), outcome },
            None => Least { omega, a_h: None, outcome: None },
        }
    };
    Ok((brackets.into_iter().enumerate().map(least).collect(), word))
}

/// Writes boundaries: one row per frequency, with and without isolation.
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
