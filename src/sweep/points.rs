//! Cells at any values of two parameters, not of a grid: what bisection asks for.

use super::error::SweepError;
use super::runner::Runner;
use crate::backend::ready::Backend;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::scene::grid::{AXES, Place};
use crate::scene::{Grid, Parameter, Scene, Values};
use crate::stepping::outcome::Outcome;
use crate::work::observer::Observer;

/// The values that there are, each once, in order.
fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Runs a scene's cells at points, each with a value of either parameter in the place of the scene's own; `plan` gives
/// the plan of a scene. The outcomes are in the points' order.
///
/// # Errors
/// Those of the plan and of the backends; that it was cancelled.
pub fn sweep_points(
    scene: &Scene,
    parameters: [Parameter; 2],
    points: &[[f64; 2]],
    plan: impl FnOnce(&Scene) -> Result<Plan, SweepError>,
    (backends, precision): (&[Backend], Precision),
    observer: &dyn Observer,
) -> Result<Vec<Outcome>, SweepError> {
    let values = [0, 1].map(|k| distinct(points.iter().map(|point| point[k])));
    let mut scene = scene.clone();
    for (parameter, values) in parameters.iter().zip(&values) {
        match values[..] {
            [] => return Ok(Vec::new()),
            [one] => scene.set(*parameter, one),
            _ => scene.set(*parameter, Values::List(values.clone())),
        }
    }
    let (plan, grid) = (plan(&scene)?, Grid::of(&scene));
    let axis =
        parameters.map(|parameter| grid.axes().iter().position(|axis| axis.parameter == parameter));
    let cell = |point: &[f64; 2]| {
        let mut place: Place = [0; AXES];
        for k in 0..2 {
            if let Some(axis) = axis[k] {
                place[axis] = values[k].partition_point(|value| *value < point[k]);
            }
        }
        grid.cell(&place)
    };
    let cells: Vec<usize> = points.iter().map(cell).collect();
    let runner = Runner { plan: &plan, grid: &grid, backends, precision, resolve: false };
    let ran = runner.list(&cells, observer)?;
    plan.forget();
    Ok(ran.outcomes)
}
