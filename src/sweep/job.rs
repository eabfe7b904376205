//! A prepared sweep: its cells, the backends that run them, and the cells that an earlier run has saved.

use std::io;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use super::batches::{Sizes, WorkReport};
use super::error::SweepError;
use super::estimate::Estimate;
use super::identity::Content;
use super::map::MapSweep;
use super::runner::Runner;
use super::settings::{MEMORY, Method, RunSettings, Saving};
use crate::backend::backend_error::BackendError;
use crate::backend::ready::Backend;
use crate::backend::report::{Report, threads};
use crate::backend::request::OpenBackends;
use crate::cells::contact::sharing;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::about::Source;
use crate::results::block::bytes_a_cell;
use crate::results::chunk::Fault;
use crate::results::collector::{OutcomeCollector, Saver};
use crate::results::outcomes::Outcomes;
use crate::results::reader::missing;
use crate::results::saved_chunks::SavedChunks;
use crate::results::store::{Contents, Store};
use crate::results::store_error::StoreError;
use crate::scene::{Grid, Parameter, Scene, SceneError, Values};
use crate::work::observer::{Observer, Phase};

/// A sweep that is prepared and can run.
pub struct Job {
    /// The plan, which has the scene.
    pub plan: Plan,
    /// Its cells.
    pub grid: Grid,
    /// The backend that runs them.
    opened: Arc<OpenBackends>,
    /// The wanted cells.
    pub wanted: Range<usize>,
    settings: RunSettings,
    opening: Duration,
    saved: Option<(Store, SavedChunks)>,
    left: Vec<Range<usize>>,
}

/// The result of a job: a map, or a shard of one.
pub enum SweepResult {
    /// A whole map.
    Map(Box<MapSweep>),
    /// A shard.
    Shard(Box<ShardSweep>),
}

/// A shard that was run.
pub struct ShardSweep {
    /// Its folder.
    pub folder: PathBuf,
    /// The backend that ran it.
    pub report: Report,
    /// GPUs that were lost on the way, by their numbers, each with its error.
    pub lost: Vec<(usize, BackendError)>,
}

/// The number of cells up to which a run takes less time than a sample of it.
const SMALL: usize = 10_000;
/// The time that a batch should take where nothing is saved.
const BATCH: Duration = Duration::from_secs(2);
/// How much slower than a batch a sample may be: it fills vectors badly, and prepares a record's motions for
/// few cells.
const SAMPLE_SLOWER: f64 = 4.0;
/// Cells that a batch may have, however little memory is to be used.
const LEAST: usize = 1 << 20;
/// Least time that a batch is to take, however often outcomes are to be saved.
const SHORTEST: Duration = Duration::from_millis(500);
/// Cells of the first batch where no sample told how long they take: few, for they may take a second each.
const UNKNOWN: usize = 1 << 5;

impl Job {
    /// Makes a scene's sweep ready, with `axes` in place of its numbers: opens the backends, and the folder
    /// in which what is done is saved.
    ///
    /// # Errors
    /// [`SweepError`]: numbers that make no sense, no backend, a folder that another run has.
    pub fn open(
        scene: &Scene,
        axes: &[(Parameter, Values)],
        settings: &RunSettings,
    ) -> Result<Job, SweepError> {
        Job::prepare(scene, axes, settings, || {
            Ok(Arc::new(settings.backend.open(settings.method.precision, &settings.adapters)?))
        })
    }

    /// The same on backends that are open, which those of the settings are not looked at for.
    ///
    /// # Errors
    /// Those of [`Job::open`], but for the backends'.
    pub fn on(
        opened: &Arc<OpenBackends>,
        scene: &Scene,
        axes: &[(Parameter, Values)],
        settings: &RunSettings,
    ) -> Result<Job, SweepError> {
        Job::prepare(scene, axes, settings, || Ok(Arc::clone(opened)))
    }

    fn prepare(
        scene: &Scene,
        axes: &[(Parameter, Values)],
        settings: &RunSettings,
        open: impl FnOnce() -> Result<Arc<OpenBackends>, SweepError>,
    ) -> Result<Job, SweepError> {
        let mut scene = scene.clone();
        for (parameter, values) in axes {
            scene.set(*parameter, values.clone());
        }
        scene.check()?;
        let plan = settings.method.plan(&scene)?;
        let grid = Grid::of(&scene);
        let saving = settings.saving.as_ref();
        settings.verify.check(grid.len())?;
        let wanted = wanted(&grid, saving)?;
        let began = Instant::now();
        let opened = open()?;
        let opening = began.elapsed();
        // A request opens one backend at least.
        let first = &opened.backends[0];
        let saved = saving.map(|saving| saved(&plan, &grid, first, settings, saving));
        let saved = saved.transpose()?;
        let done = saved.as_ref().map(|(_, found)| found.done()).unwrap_or_default();
        let left = missing(&done, &wanted);
        let settings = settings.clone();
        Ok(Job { plan, grid, opened, wanted, settings, opening, saved, left })
    }

    /// The backend that runs its cells: one backend, or several GPUs that are alike.
    pub fn backends(&self) -> &[Backend] {
        &self.opened.backends
    }

    /// The same backend, to run further cells.
    pub fn opened(&self) -> &Arc<OpenBackends> {
        &self.opened
    }

    /// Errors of GPUs that are listed and were skipped.
    pub fn passed_over(&self) -> &[BackendError] {
        &self.opened.passed_over
    }

    /// A checksum of all that its outcomes depend on; none where nothing is saved.
    pub fn tag(&self) -> Option<u32> {
        self.saved.as_ref().map(|(store, _)| store.tag())
    }

    /// How cells are computed.
    pub fn method(&self) -> &Method {
        &self.settings.method
    }

    /// The number of cells that have not run.
    pub fn left(&self) -> usize {
        self.left.iter().map(Range::len).sum()
    }

    /// Files of an earlier run that are damaged, each with what is wrong; their cells are run again.
    pub fn broken(&self) -> &[(PathBuf, Fault)] {
        self.saved.as_ref().map_or(&[], |(_, found)| &found.broken)
    }

    /// What the cells that are left will take, from a sample of them; none where they are so few that they are
    /// done before a sample would be.
    ///
    /// # Errors
    /// Those of the backend.
    pub fn estimate_if_long(
        &self,
        observer: &dyn Observer,
    ) -> Result<Option<Estimate>, SweepError> {
        match self.left() {
            few if few < SMALL => Ok(None),
            _ => self.estimate(observer).map(Some),
        }
    }

    /// What the cells that are left will take, from a sample of them.
    ///
    /// # Errors
    /// Those of the backend.
    pub fn estimate(&self, observer: &dyn Observer) -> Result<Estimate, SweepError> {
        let scene = &self.plan.scene;
        Estimate::of(scene, &self.settings.method, &self.backends()[0], self.left(), observer)
    }

    /// Bytes that the columns of a given number of cells take in memory.
    pub fn bytes(&self, cells: usize) -> u64 {
        cells as u64 * bytes_a_cell(self.columns()) as u64
    }

    /// Bytes of the motions in full contact that its cells share.
    pub fn bytes_shared(&self) -> usize {
        sharing::bytes_shared(&self.plan, &self.grid, self.method().precision)
    }

    /// True where the map is held in memory until it is written.
    pub fn holds(&self) -> bool {
        self.settings.saving.as_ref().is_none_or(|saving| {
            saving.shard.is_none() && self.bytes(self.grid.len()) <= saving.memory
        })
    }

    /// The number type of its columns.
    fn columns(&self) -> Precision {
        self.backends()[0].columns(self.settings.method.precision)
    }

    /// Runs what is left; `estimate` tells how many cells a batch may have.
    ///
    /// # Errors
    /// [`SweepError`]; more cells than memory holds where nothing is saved; where something was saved,
    /// [`SweepError::Stopped`] says how much.
    pub fn run(
        self,
        estimate: Option<&Estimate>,
        observer: &dyn Observer,
    ) -> Result<SweepResult, SweepError> {
        if self.settings.saving.is_none() {
            check_held(&self.grid)?;
        }
        let (outcomes, work) = self.collect(estimate, observer)?;
        let report = self.report(estimate, &work);
        let Job { plan, grid, settings, saved, opened, .. } = self;
        let store = saved.map(|(store, _)| store);
        let Some(outcomes) = outcomes else {
            let Some(store) = store else { return Err(StoreError::Incomplete.into()) };
            let resumed = report.resumed_cells == report.cells;
            let folder = store.finish(&report, resumed)?;
            return Ok(SweepResult::Shard(Box::new(ShardSweep {
                folder,
                report,
                lost: work.lost,
            })));
        };
        let lost = work.lost;
        let shards = vec![(None, report)];
        let repair = settings.method.repair;
        let memory = settings.saving.as_ref().map_or(MEMORY, |saving| saving.memory);
        let mut sweep = MapSweep {
            plan,
            grid,
            method: settings.method,
            outcomes,
            shards,
            lost,
            repair: None,
            verification: None,
            store,
        };
        if repair && let Err(error) = sweep.repair(&opened.backends, memory, observer) {
            return Err(sweep.stopped(error));
        }
        Ok(SweepResult::Map(Box::new(sweep)))
    }

    /// The outcomes of all cells, but for a shard, which stays on disk.
    fn collect(
        &self,
        estimate: Option<&Estimate>,
        observer: &dyn Observer,
    ) -> Result<(Option<Box<dyn Outcomes>>, WorkReport), SweepError> {
        let at_once = self.settings.saving.as_ref().is_some_and(|saving| saving.ends_at_once);
        let go_on = || !(at_once && observer.cancelled());
        let collector = self.collector(&go_on)?;
        let work = thread::scope(|scope| {
            let saved = self.saved.as_ref().map(|_| scope.spawn(|| collector.save_meanwhile()));
            let ended = collector.ends_when_dropped();
            let work = self.work(estimate, &collector, observer);
            drop(ended);
            match saved.map(ScopedJoinHandle::join) {
                Some(Ok(Err(error))) => Err(error.into()),
                Some(Err(panic)) => resume_unwind(panic),
                Some(Ok(Ok(()))) | None => work,
            }
        });
        self.plan.forget();
        let work = match work {
            Ok(work) => work,
            Err(error) => {
                // What was done is to be found again; where it cannot be saved, that error was the first.
                let _ = collector.rescue();
                let saved = collector.cells_on_disk();
                return Err(match &self.saved {
                    Some((store, _)) if saved > 0 => {
                        error.stopped(saved, self.wanted.len(), store.path())
                    }
                    _ => error,
                });
            }
        };
        let shard = self.settings.saving.as_ref().is_some_and(|saving| saving.shard.is_some());
        let saved = collector.cells_on_disk();
        let ended = |error| match (&self.saved, error) {
            // It was ended while the last chunks were saved.
            (Some((store, _)), StoreError::Incomplete) if !go_on() => {
                let cancelled = SweepError::from(BackendError::Cancelled);
                cancelled.stopped(saved, self.wanted.len(), store.path())
            }
            (_, error) => SweepError::from(error),
        };
        if shard {
            collector.finish_shard().map_err(ended)?;
            return Ok((None, work));
        }
        Ok((Some(collector.finish().map_err(ended)?), work))
    }

    /// What collects the outcomes; a saving goes on while it is to `go_on`.
    fn collector<'a>(
        &'a self,
        go_on: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<OutcomeCollector<'a>, SweepError> {
        let wanted = self.wanted.clone();
        let (Some((store, found)), Some(saving)) = (&self.saved, &self.settings.saving) else {
            let columns = self.settings.method.columns.held();
            return Ok(OutcomeCollector::in_memory(self.grid.len(), self.columns(), columns));
        };
        let threads = if self.backends()[0].hands_over_cells() { 1 } else { threads() };
        let threads = NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN);
        let saver = Saver { store, patience: saving.every, holds: self.holds(), threads, go_on };
        Ok(OutcomeCollector::saving(saver, found, wanted)?)
    }

    /// Runs what is left on all backends, until saving fails.
    fn work(
        &self,
        estimate: Option<&Estimate>,
        collector: &OutcomeCollector,
        observer: &dyn Observer,
    ) -> Result<WorkReport, SweepError> {
        /// Ends the work, too, where saving failed.
        struct UntilFailed<'a>(&'a dyn Observer, &'a OutcomeCollector<'a>);
        impl Observer for UntilFailed<'_> {
            fn advance(&self, cells: usize) {
                self.0.advance(cells);
            }
            fn cancelled(&self) -> bool {
                self.0.cancelled() || self.1.failed()
            }
        }
        let (Job { plan, grid, .. }, backends) = (self, self.backends());
        let Method { precision, resolve, .. } = self.settings.method;
        let cells = self.left();
        observer.begins(Phase::Sweeping, if resolve { 2 * cells } else { cells });
        let runner = Runner { plan, grid, backends, precision, resolve };
        // Of a map that memory does not hold, the chunks of the batches that run are held.
        let most = match &self.settings.saving {
            Some(saving) if !self.holds() => {
                let held = saving.memory / (2 * self.bytes(backends.len())).max(1);
                runner.most(cells).min((held as usize).max(LEAST))
            }
            _ => runner.most(cells),
        };
        let every = self.settings.saving.as_ref().map(|saving| saving.every);
        let takes = every.map_or(BATCH, |every| every.max(SHORTEST));
        // Cells that are slow are to be saved in time, too.
        let first = estimate.map_or(UNKNOWN, |estimate| {
            (SAMPLE_SLOWER * estimate.rate * takes.as_secs_f64()) as usize
        });
        let sizes = match backends[0].hands_over_cells() {
            true => Sizes::fixed(most),
            false => Sizes { first, most, takes },
        };
        Ok(runner.ranges(&self.left, sizes, collector, &UntilFailed(observer, collector))?)
    }

    fn report(&self, estimate: Option<&Estimate>, work: &WorkReport) -> Report {
        let sampled = estimate.map_or(Duration::ZERO, |estimate| estimate.compile);
        let backend = &self.backends()[0];
        let is_shard = self.settings.saving.as_ref().is_some_and(|saving| saving.shard.is_some());
        Report {
            first: self.wanted.start,
            cells: self.wanted.len(),
            backend: backend.name().into(),
            adapter: backend.adapter().cloned(),
            devices: self.backends().len(),
            threads: threads(),
            start: (self.opening + sampled + work.compile).as_secs_f64(),
            sweep: work.elapsed.as_secs_f64(),
            resumed_cells: self.wanted.len() - self.left(),
            record: is_shard.then(|| self.plan.scene.excitation.provenance().cloned()).flatten(),
        }
    }
}

/// Most cells of a map that is held in memory: its columns take some 15 GiB.
const MOST_HELD: usize = 1 << 28;

/// Refuses a map that is saved nowhere and has more cells than are held.
///
/// # Errors
/// The key `out`.
pub fn check_held(grid: &Grid) -> Result<(), SceneError> {
    if grid.len() > MOST_HELD {
        let problem = format!(
            "{} cells are more than the {MOST_HELD} that are held in memory; give a directory, or fewer points",
            grid.len()
        );
        return Err(SceneError::new("out", problem));
    }
    Ok(())
}

/// The cells to run.
fn wanted(grid: &Grid, saving: Option<&Saving>) -> Result<Range<usize>, SceneError> {
    let Some(shard) = saving.and_then(|saving| saving.shard) else { return Ok(0..grid.len()) };
    let cells = shard.cells(grid.len());
    if cells.is_empty() {
        let problem = format!("shard {shard} of {} cells has none; give fewer shards", grid.len());
        return Err(SceneError { key: "tile", problem });
    }
    Ok(cells)
}

/// The folder in which the run saves what is done, and what an earlier one left there.
fn saved(
    plan: &Plan,
    grid: &Grid,
    backend: &Backend,
    settings: &RunSettings,
    saving: &Saving,
) -> Result<(Store, SavedChunks), SweepError> {
    let content = Content::new(&plan.scene, backend, &settings.method, saving.shard);
    let identity = content.identity().map_err(io::Error::from)?;
    let source = Source {
        scene: &plan.scene,
        precision: content.columns(),
        columns: settings.method.columns,
    };
    let contents = Contents { grid, source };
    Store::open(&saving.directory, identity, contents, saving.resume).map_err(SweepError::Folder)
}
