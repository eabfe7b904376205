//! The one way from a sweep to its backends: all cells of a grid, or a list of them; for the first time, or again with other
//! steps or on a finer grid.

use std::borrow::Cow;
use std::convert::Infallible;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::batches::{self, BatchError, Sizes, WorkReport, Worker};
use crate::backend::backend_error::BackendError;
use crate::backend::cell_run::{CellRun, Snapshots};
use crate::backend::ready::Backend;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::results::columns::Column;
use crate::scene::Grid;
use crate::stepping::outcome::Outcome;
use crate::work::observer::Observer;

/// Least time between two snapshots of a batch, and least time that a batch is to take, however often finished cells are to
/// be saved.
pub(crate) const SHORTEST: Duration = Duration::from_millis(500);

/// The outcomes of a list of cells.
#[derive(Debug, Clone)]
pub struct ListOutcomes {
    /// One for each cell, in the list's order.
    pub outcomes: Vec<Outcome>,
    /// Time of the sweep.
    pub elapsed: Duration,
}

/// The cells at some places of a list.
type CellsAt<'c> = dyn Fn(Range<usize>) -> Cow<'c, [usize]> + Sync + 'c;

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
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        let some = |places: Range<usize>| cells[places].into();
        let (sizes, all) = (Sizes::fixed(self.most(cells.len())), 0..cells.len());
        let work = self.batches((&some, &[all]), sizes, None, observer, |first, block| {
            block.read(0, &Column::ALL, &mut outcomes[first..first + block.len()]);
            Ok::<(), Infallible>(())
        });
        let work = work.map_err(|error| match error {
            BatchError::Backend(error) => error,
            BatchError::Keep(never) => match never {},
        })?;
        Ok(ListOutcomes { outcomes, elapsed: work.elapsed })
    }

    /// Runs ranges of the grid's cells in batches of these sizes. `keep` is handed what is done, by the number of the first
    /// cell: whole batches, and `every` so often what is done of one that goes on.
    ///
    /// # Errors
    /// Those of the backend; that it was cancelled; those of `keep`.
    pub(crate) fn ranges<E: Send>(
        &self,
        ranges: &[Range<usize>],
        sizes: Sizes,
        every: Option<Duration>,
        observer: &dyn Observer,
        keep: impl FnMut(usize, Block) -> Result<(), E> + Send,
    ) -> Result<WorkReport, BatchError<E>> {
        let cells = |cells: Range<usize>| cells.collect::<Vec<usize>>().into();
        self.batches((&cells, ranges), sizes, every, observer, keep)
    }

    /// Most cells of a batch of so many: several workers are all to have some, and to end together.
    pub(crate) fn most(&self, cells: usize) -> usize {
        match self.backends.len() {
            1 => self.backends[0].batch(),
            several => self.backends[0].batch().min(cells.div_ceil(4 * several).max(1)),
        }
    }

    /// Runs what is at places of a list in batches.
    fn batches<'c, E: Send>(
        &self,
        (cells, places): (&CellsAt<'c>, &[Range<usize>]),
        sizes: Sizes,
        every: Option<Duration>,
        observer: &dyn Observer,
        keep: impl FnMut(usize, Block) -> Result<(), E> + Send,
    ) -> Result<WorkReport, BatchError<E>> {
        let worker = |backend| -> Worker<'_> {
            let backend: &Backend = backend;
            Box::new(move |places, hand_over| {
                let (first, last) = (places.start, Mutex::new(Instant::now()));
                let due = || {
                    let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
                    let due = every.is_some_and(|every| last.elapsed() >= every.max(SHORTEST));
                    if due {
                        *last = Instant::now();
                    }
                    due
                };
                let take = |block| hand_over(first, block);
                let snapshots = every.map(|_| Snapshots { due: &due, take: &take });
                let run = CellRun::of(self.plan, self.grid, cells(places), self.precision);
                let run = CellRun { snapshots, ..run.resolving(self.resolve) };
                backend.run(&run, observer)
            })
        };
        let workers: Vec<Worker> = self.backends.iter().map(worker).collect();
        batches::sweep(&workers, places, sizes, keep)
    }
}
