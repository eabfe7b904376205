//! Some cells of a scene's grid alone, by their numbers.

use super::error::SweepError;
use super::runner::{ListOutcomes, Runner};
use super::settings::{Method, RunSettings};
use crate::scene::{Grid, Parameter, Scene, SceneError, Values};
use crate::work::observer::{Observer, Phase};

/// Runs some cells of a scene's grid alone, with `axes` in place of its numbers: the grid may be far finer than one
/// that could be swept as a whole. Cells are numbered as those of a [`Grid`], the first axis fastest
/// ([`Grid::cell`]), and may come in any order. The outcomes are those of a sweep of the whole grid, on the CPU to the
/// last bit. [`RunSettings::saving`] and [`RunSettings::verify`] are not looked at, nor is
/// [`Method::repair`](super::settings::Method::repair).
///
/// # Errors
/// [`SweepError`]: numbers that make no sense, a cell that the grid does not have (key `cells`), a backend that
/// failed, an observer that ended it.
pub fn sweep_cells(
    scene: &Scene,
    axes: &[(Parameter, Values)],
    cells: &[usize],
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<ListOutcomes, SweepError> {
    let mut scene = scene.clone();
    for (parameter, values) in axes {
        scene.set(*parameter, values.clone());
    }
    scene.check()?;
    let method = settings.method;
    let (plan, grid) = (method.plan(&scene)?, Grid::of(&scene));
    if let Some(cell) = cells.iter().find(|cell| **cell >= grid.len()) {
        let problem = format!("there is no cell {cell}; the grid has {}, from 0 on", grid.len());
        return Err(SceneError::new("cells", problem).into());
    }
    let opened = settings.backend.open(method.precision, &settings.adapters)?;
    observer.begins(Phase::Sweeping, cells.len() * if method.resolve { 2 } else { 1 });
    let Method { precision, resolve, .. } = method;
    let runner =
        Runner { plan: &plan, grid: &grid, backends: &opened.backends, precision, resolve };
    Ok(runner.list(cells, observer)?)
}
