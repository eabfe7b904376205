//! The one way from a sweep to its backends: all cells of a grid, or a list of them; for the first time, or again with other
//! steps or on a finer grid.

use std::ops::Range;
use std::time::Duration;

use super::batches::{self, Sizes, WorkReport, Worker};
use crate::backend::backend_error::BackendError;
use crate::backend::cell_run::CellRun;
use crate::backend::ready::Backend;
use crate::backend::sink::Sink;
use crate::cells::cell_list::CellList;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::collector::OutcomeCollector;
use crate::results::column_set::ColumnSet;
use crate::scene::Grid;
use crate::stepping::outcome::Outcome;
use crate::work::observer::Observer;

/// The outcomes of a list of cells.
#[derive(Debug, Clone)]
pub struct ListOutcomes {
    /// One for each cell, in the list's order.
    pub outcomes: Vec<Outcome>,
    /// Time of the sweep.
    pub elapsed: Duration,
}

/// Runs cells of a plan's grid.
#[derive(Clone, Copy)]
pub struct Runner<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The grid that numbers the cells.
    pub grid: &'a Grid,
    /// The backend that runs them: one, or several GPUs that are alike.
    pub backends: &'a [Backend],
    /// Number type.
    pub precision: Precision,
    /// Each cell runs twice, see [`Method::resolve`](super::settings::Method::resolve).
    pub resolve: bool,
}

impl Runner<'_> {
    /// Runs a list of cells; `observer` hears of each. Lists in the grid's order run fastest: neighbours do much the same.
    ///
    /// # Errors
    /// Those of the backend; that it was cancelled.
    pub fn list(
        &self,
        cells: &[usize],
        observer: &dyn Observer,
    ) -> Result<ListOutcomes, BackendError> {
        let collector = OutcomeCollector::in_memory(cells.len(), self.columns(), ColumnSet::EVERY);
        let (sizes, all) = (Sizes::fixed(self.most(cells.len())), 0..cells.len());
        let work = self.batches(cells.into(), &[all], sizes, &collector, observer)?;
        Ok(ListOutcomes { outcomes: collector.into_block().to_outcomes(), elapsed: work.elapsed })
    }

    /// Runs ranges of the grid's cells in batches of these sizes.
    ///
    /// # Errors
    /// Those of the backend; that it was cancelled. What was collected before is right.
    pub(crate) fn ranges(
        &self,
        ranges: &[Range<usize>],
        sizes: Sizes,
        collector: &OutcomeCollector,
        observer: &dyn Observer,
    ) -> Result<WorkReport, BackendError> {
        self.batches((0..self.grid.len()).into(), ranges, sizes, collector, observer)
    }

    /// The number type of the columns of what it runs.
    fn columns(&self) -> Precision {
        // There is one backend at least.
        let backend = &self.backends[0];
        let finest = if self.resolve { backend.finest(self.precision) } else { self.precision };
        backend.columns(finest)
    }

    /// Most cells of a batch of so many: several workers are all to have some, and to end together.
    pub(crate) fn most(&self, cells: usize) -> usize {
        match self.backends.len() {
            1 => self.backends[0].batch(),
            several => self.backends[0].batch().min(cells.div_ceil(4 * several).max(1)),
        }
    }

    /// Runs what is at places of a list in batches; the collector has its cells by their places.
    fn batches(
        &self,
        cells: CellList,
        places: &[Range<usize>],
        sizes: Sizes,
        collector: &OutcomeCollector,
        observer: &dyn Observer,
    ) -> Result<WorkReport, BackendError> {
        let worker = |backend| -> Worker<'_> {
            let backend: &Backend = backend;
            Box::new(move |places| {
                let sink = Sink::from(places.start, collector);
                let run = CellRun::of(self.plan, self.grid, cells.part(places), self.precision);
                backend.run_into(&run.resolving(self.resolve), sink, observer)
            })
        };
        let workers: Vec<Worker> = self.backends.iter().map(worker).collect();
        batches::sweep(&workers, places, sizes)
    }
}
