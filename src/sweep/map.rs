//! A finished sweep: the outcomes, the backends that ran them, and the verification of a sample.

use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::error::SweepError;
use super::repaired::Repair;
use super::sample::{self, Chosen};
use super::settings::{Method, VerifySettings};
use super::shards::Shards;
use super::verification::{self, Verification};
use crate::backend::backend_error::BackendError;
use crate::backend::ready::Backend;
use crate::backend::report::{self, Report};
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::about::Source;
use crate::results::block::{Block, ColumnValues};
use crate::results::columns::Column;
use crate::results::observed::ObservedOutcomes;
use crate::results::outcomes::{Outcomes, each_block};
use crate::results::rounds::Rounds;
use crate::results::store::Store;
use crate::results::store_error::StoreError;
use crate::results::tally::{self, Tally};
use crate::scene::Grid;
use crate::stepping::outcome::Outcome;
use crate::work::observer::{Observer, Phase};

/// A map whose cells have run.
pub struct MapSweep {
    /// The plan, which has the scene.
    pub plan: Plan,
    /// Its cells.
    pub grid: Grid,
    /// How they were computed.
    pub method: Method,
    /// The outcomes of the cells.
    pub outcomes: Box<dyn Outcomes>,
    /// The backend that ran them, shard by shard; a part of another run has a folder.
    pub shards: Vec<(Option<PathBuf>, Report)>,
    /// GPUs that were lost on the way, by their numbers, each with its error.
    pub lost: Vec<(usize, BackendError)>,
    /// How the map was repaired; none where it was not.
    pub repair: Option<Repair>,
    /// The verification by the reference; none where it was not asked for.
    pub verification: Option<Verification>,
    /// The folder in which the outcomes are saved.
    pub(crate) store: Option<Store>,
}

impl MapSweep {
    /// The map of shards; `store` is the folder of the directory that it is to be written to.
    ///
    /// # Errors
    /// Those of [`Plan::new`].
    pub fn of_shards(shards: Shards, store: Option<Store>) -> Result<MapSweep, SweepError> {
        let Shards { content, reports, reader } = shards;
        let shards = reports.into_iter().map(|(folder, report)| (Some(folder), report)).collect();
        Ok(MapSweep {
            plan: content.method.plan(&content.scene)?,
            grid: Grid::of(&content.scene),
            method: content.method,
            outcomes: Box::new(reader),
            shards,
            lost: Vec::new(),
            repair: None,
            verification: None,
            store,
        })
    }

    /// The number type of its columns: f64 where the reference ran any of it.
    pub fn precision(&self) -> Precision {
        report::columns(&self.shards, self.method.precision)
    }

    /// Seconds that its cells took, all shards together.
    pub fn sweep_seconds(&self) -> f64 {
        self.shards.iter().map(|(_, report)| report.sweep).sum()
    }

    /// What the files of the map say about its origin.
    pub fn source(&self) -> Source<'_> {
        Source {
            scene: &self.plan.scene,
            precision: self.precision(),
            columns: self.method.columns,
        }
    }

    /// The outcome of a cell.
    ///
    /// # Errors
    /// Those of reading, where it is on disk.
    pub fn outcome(&self, cell: usize) -> io::Result<Outcome> {
        Ok(self.outcomes.read(cell..cell + 1, &Column::ALL)?[0])
    }

    /// A column as numbers, one a cell in the grid's order: codes by their place in
    /// [`Class::ALL`](crate::stepping::outcome::Class::ALL) or
    /// [`STATUS_NAMES`](crate::results::columns::STATUS_NAMES), a time that a cell does not have not a number.
    ///
    /// # Errors
    /// Those of reading, where they are on disk; a column that was [not asked for](Method::columns).
    pub fn column(&self, column: Column) -> io::Result<Vec<f64>> {
        if !self.method.columns.held().has(column) {
            let problem = format!("{} was not asked for", column.entry().name);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
        let mut values = Vec::with_capacity(self.grid.len());
        let entry = column.entry();
        each_block(self.grid.len(), &*self.outcomes, &[column], |_, block| {
            values.extend(block.iter().map(|cell| entry.shown(cell).number()));
            Ok(())
        })?;
        Ok(values)
    }

    /// Columns that were requested, in the table's order, numbers as wide as the sweep's; outcomes and statuses are places in
    /// [`Class::ALL`](crate::stepping::outcome::Class::ALL) and
    /// [`Status::ALL`](crate::stepping::outcome::Status::ALL).
    ///
    /// # Errors
    /// Those of reading, where they are on disk.
    pub fn into_columns(self) -> io::Result<Vec<(Column, ColumnValues)>> {
        let (precision, asked) = (self.precision(), self.method.columns);
        Ok(self.outcomes.into_block(self.grid.len(), precision)?.into_columns(asked))
    }

    /// Counts its cells.
    ///
    /// # Errors
    /// Those of reading; [`SweepError::Read`] where it is cancelled.
    pub fn tally(&self, observer: &dyn Observer) -> Result<Tally, SweepError> {
        observer.begins(Phase::Counting, self.grid.len() * tally::COLUMNS.len());
        let outcomes = ObservedOutcomes::new(&*self.outcomes, observer);
        Ok(Tally::of(&self.grid, &outcomes, self.method.columns)?)
    }

    /// True where the reference computed the whole map, so that there is nothing to verify.
    pub fn by_reference(&self) -> bool {
        self.shards.iter().all(|(_, report)| report.backend == Backend::Reference.name())
    }

    /// Runs a sample of its cells again by the reference; those that are not done in the time of the settings
    /// are left out.
    ///
    /// # Errors
    /// Those of reading; where it is cancelled, [`SweepError::is_cancelled`] is true of it.
    pub fn verify(
        &self,
        settings: &VerifySettings,
        observer: &dyn Observer,
    ) -> Result<Verification, SweepError> {
        let chosen = self.choose(settings.cells, observer)?;
        observer.begins(Phase::Verifying, chosen.len());
        let sample = (&chosen[..], settings.within);
        let of = (&self.plan, self.method.columns);
        let verified = verification::verify(of, &self.grid, sample, observer);
        verified.ok_or(BackendError::Cancelled.into())
    }

    /// The cells for the reference to run again, with their outcomes: [`verification::verify`] runs them.
    ///
    /// # Errors
    /// Those of reading; [`SweepError::Read`] where it is cancelled.
    pub fn choose(&self, cells: usize, observer: &dyn Observer) -> Result<Vec<Chosen>, SweepError> {
        // They are chosen in two readings of a column, and read.
        let (all, columns) = (self.grid.len(), Column::ALL.len());
        observer.begins(Phase::Choosing, 2 * all + columns * cells.min(all));
        let watched = ObservedOutcomes::new(&*self.outcomes, observer);
        Ok(sample::sample(&self.grid, &watched, cells)?)
    }

    /// Writes it as a Zarr group, in the place of one that is there. `observer` hears of its chunks' cells. What
    /// was saved while it ran is used for it, and goes; outcomes that are not in memory are read from the group
    /// from then on.
    ///
    /// # Errors
    /// Errors of the disk; a map without a directory to be saved in has none to be written to.
    pub fn publish(&mut self, place: &Path, observer: &dyn Observer) -> Result<(), SweepError> {
        let Some(store) = &self.store else { return Err(StoreError::Incomplete.into()) };
        let whole = store.found()?;
        let chunking = store.files().chunking.clone();
        observer.begins(Phase::Writing, self.grid.len());
        let go_on = || !observer.cancelled();
        let mut saved: usize = whole.done().iter().map(Range::len).sum();
        for chunk in 0..chunking.count() {
            let cells = chunking.cells(chunk);
            let found = whole.chunks.iter().find(|saved| saved.chunk == chunk);
            let replaced = self.repair.as_ref().is_some_and(|repair| repair.touches(&cells));
            if replaced || found.is_none_or(|found| found.done != [cells.clone()]) {
                let mut block = Block::pending(cells.len(), store.files().precision);
                block.put(0, &self.outcomes.read(cells.clone(), &Column::ALL)?);
                if store.save_while(chunk, &block, &go_on)? {
                    // Some of them may have been there.
                    let before = found.map_or(0, |found| found.done.iter().map(Range::len).sum());
                    saved += cells.len() - before;
                }
            }
            observer.advance(cells.len());
            if observer.cancelled() {
                let cancelled = SweepError::from(BackendError::Cancelled);
                return Err(cancelled.stopped(saved, self.grid.len(), store.path()));
            }
        }
        let from = store.path().to_path_buf();
        if let Some(store) = self.store.take() {
            store.publish(place)?;
            self.outcomes.moved(&from, place);
        }
        Ok(())
    }

    /// An error of the work on it, with where it is saved, if it is.
    pub fn stopped(&self, error: SweepError) -> SweepError {
        match self.saved_in() {
            Some(folder) => error.stopped(self.grid.len(), self.grid.len(), folder),
            None => error,
        }
    }

    /// Where it is saved, if it is.
    pub(crate) fn saved_in(&self) -> Option<&Path> {
        self.store.as_ref().filter(|store| store.is_used()).map(Store::path)
    }

    /// Lists of cells of a finer grid, saved beside it in a folder of this name; none of a map that is not saved.
    ///
    /// # Errors
    /// Errors of the disk.
    pub(crate) fn rounds(&self, name: &str) -> Result<Option<Rounds>, StoreError> {
        self.store.as_ref().map(|store| store.rounds(name)).transpose()
    }

    /// Takes away what was saved while it ran: its files are written. Outcomes that are not in memory cannot be
    /// read from then on.
    ///
    /// # Errors
    /// Errors of the disk.
    pub fn discard_saved(&mut self) -> Result<(), SweepError> {
        self.store.take().map_or(Ok(()), Store::discard).map_err(SweepError::from)
    }
}
