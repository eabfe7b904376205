//! Lists of a grid's cells, by their numbers: what refinement, repair and bisection ask for.

use std::convert::Infallible;
use std::time::Duration;

use super::batches::{self, BatchError, Sizes, Worker};
use super::error::SweepError;
use super::settings::RunSettings;
use crate::backend::backend_error::BackendError;
use crate::backend::dispatch::Backend;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::columns::Column;
use crate::scene::{Grid, Parameter, Scene, SceneError, Values};
use crate::stepping::outcome::Outcome;
use crate::work::observer::{Observer, Phase};

/// The outcomes of a list of cells.
#[derive(Debug, Clone)]
pub struct ListOutcomes {
    /// One a cell, in the list's order.
    pub outcomes: Vec<Outcome>,
    /// Time of the sweep.
    pub elapsed: Duration,
}

/// Runs lists of cells of a plan's grid.
#[derive(Clone, Copy)]
pub struct ListSweep<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The grid that numbers the cells.
    pub grid: &'a Grid,
    /// What runs them: one, or several GPUs that are alike.
    pub backends: &'a [Backend],
    /// Number type.
    pub precision: Precision,
    /// Each cell runs twice, see [`Method::resolve`](super::settings::Method::resolve).
    pub resolve: bool,
}

impl ListSweep<'_> {
    /// Runs the cells of these numbers; `observer` hears of cells. Lists in the grid's order run fastest: neighbours
    /// do much the same.
    ///
    /// # Errors
    /// Those of the backend; that it was cancelled.
    pub fn run(
        &self,
        cells: &[usize],
        observer: &dyn Observer,
    ) -> Result<ListOutcomes, BackendError> {
        let ListSweep { plan, grid, backends, precision, resolve } = *self;
        let worker = |backend| -> Worker<'_> {
            let backend: &Backend = backend;
            Box::new(move |places, _| {
                backend.sweep_list(plan, grid, &cells[places], (precision, resolve), observer)
            })
        };
        let workers: Vec<Worker> = backends.iter().map(worker).collect();
        // Several workers are all to have some, and to end together.
        let most = match workers.len() {
            1 => backends[0].batch(),
            several => backends[0].batch().min(cells.len().div_ceil(4 * several).max(1)),
        };
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        let places = 0..cells.len();
        let work = batches::sweep(&workers, &[places], Sizes::fixed(most), |first, some| {
            some.read(0, &Column::ALL, &mut outcomes[first..first + some.len()]);
            Ok::<(), Infallible>(())
        });
        let work = work.map_err(|error| match error {
            BatchError::Backend(error) => error,
            BatchError::Keep(never) => match never {},
        })?;
        Ok(ListOutcomes { outcomes, elapsed: work.elapsed })
    }
}

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
    let (precision, resolve) = (method.precision, method.resolve);
    let list =
        ListSweep { plan: &plan, grid: &grid, backends: &opened.backends, precision, resolve };
    Ok(list.run(cells, observer)?)
}
