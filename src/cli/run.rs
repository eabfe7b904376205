//! From a scene to outcomes: a map, or a part of one.

use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use topple::map::outcomes::Outcomes;
use topple::scene::{Grid, Scene};
use topple::store::identity::Identity;
use topple::store::keeper::Keeper;
use topple::store::part::Part;
use topple::store::parts::Report;
use topple::store::shelf::missing;
use topple::store::{Found, Store, StoreError};
use topple::sweep::backend::Backend;
use topple::sweep::plan::Plan;
use topple::sweep::tiles::{self, Sizes, Took, Worker};

use super::finish::{self, Finished};
use super::options::{MapOptions, RunOptions, flag_error};
use super::progress::Progress;
use super::words::{self, Say};
use super::{InputError, estimate, memory, output};

/// Runs a scene's map and writes its files, or runs a part of it and leaves its tiles.
pub fn run_map(scene: &Scene, options: &MapOptions) -> anyhow::Result<()> {
    let plan = options.run.plan(scene).map_err(|e| flag_error(&e))?;
    let grid = Grid::of(scene);
    let wanted = cells(&grid, options.tile)?;
    if options.dry_run {
        return estimate::tell(&plan, &grid, options, &wanted);
    }
    let out = output::open(&options.run.out)?;
    let opening = Instant::now();
    let backends = options.run.open_backends()?;
    let opened = opening.elapsed();
    // A request opens one backend at least.
    let backend = &backends[0];
    let (store, found) = unfinished(scene, backend, options)?;
    let left = missing(&found.tiles, &wanted);
    let missing_cells: usize = left.iter().map(Range::len).sum();
    let resumed_cells = wanted.len() - missing_cells;
    let takes = match estimate::before(&plan, &grid, options, &backends, missing_cells) {
        Ok(takes) => takes,
        Err(error) => {
            store.discard_if_empty()?;
            return Err(error);
        }
    };
    let say = Say::unless(options.run.quiet);
    words::head(&say, &plan, &grid, &backends, options.run.precision);
    words::warn_of_cut_pulses(&grid);
    for (path, reason) in &found.broken {
        say.line("again", format!("{}: {reason}", path.display()));
    }
    if let Some(part) = options.tile {
        say.line("part", format!("{part}, {} cells from number {} on", wanted.len(), wanted.start));
    }
    if resumed_cells > 0 {
        say.line("resumed", format!("{resumed_cells} of {} cells were done", wanted.len()));
    } else if options.resume {
        say.line("resumed", "nothing: no cell of this run was kept; it begins at the start");
    }
    if missing_cells > 0 {
        say.line("takes", &takes.line);
    }
    let rate = takes.rate;
    let job = Job { plan: &plan, grid: &grid, backends: &backends, options, store: &store, rate };
    let swept = job.sweep(found, &left);
    let (outcomes, took) = match swept {
        Ok(swept) => swept,
        Err(error) if store.discard_if_empty()? => {
            return Err(error.context("interrupted; --resume goes on from what is done"));
        }
        Err(error) => return Err(error),
    };
    for (number, error) in &took.lost {
        say.line("lost", format!("GPU {number}: {error}; the others did its cells"));
    }
    let report = Report {
        first: wanted.start,
        cells: wanted.len(),
        backend: backend.name().into(),
        adapter: backend.adapter().cloned(),
        devices: backends.len(),
        threads: words::threads(),
        start: (opened + takes.compile + took.compile).as_secs_f64(),
        sweep: took.elapsed.as_secs_f64(),
        resumed_cells,
    };
    if missing_cells > 0 {
        say.line("sweep", words::speed(missing_cells, report.sweep));
    }
    let Some(outcomes) = outcomes else {
        let folder = store.finish(&report)?;
        say.line("tiles", format!("{}; topple merge joins the parts", folder.display()));
        return Ok(());
    };
    let finished = Finished {
        plan: &plan,
        grid,
        outcomes: outcomes.as_ref(),
        manner: options.run.manner(),
        parts: vec![(None, report)],
    };
    finish::write(&out, &finished, &say)?;
    drop(outcomes);
    store.discard()?;
    Ok(())
}

/// The cells to run.
fn cells(grid: &Grid, part: Option<Part>) -> Result<Range<usize>, InputError> {
    let Some(part) = part else { return Ok(0..grid.len()) };
    let cells = part.cells(grid.len());
    if cells.is_empty() {
        let problem = format!("part {part} of {} cells has none; give fewer parts", grid.len());
        return Err(InputError(format!("--tile: {problem}")));
    }
    Ok(cells)
}

/// The folder in which the run keeps what is done, and what an earlier one left there.
fn unfinished(
    scene: &Scene,
    backend: &Backend,
    options: &MapOptions,
) -> anyhow::Result<(Store, Found)> {
    let identity = Identity::new(scene, backend, &options.run.manner(), options.tile)?;
    open_store(&options.run.out, identity, options.resume)
}

/// Opens a run's folder; what is wrong with it is the directory's fault, given by `--out`.
pub fn open_store(out: &Path, identity: Identity, resume: bool) -> anyhow::Result<(Store, Found)> {
    Store::open(out, identity, resume).map_err(|error| match error {
        StoreError::InUse(_) | StoreError::Unfinished(_) | StoreError::Other { .. } => {
            InputError(format!("--out: {error}")).into()
        }
        other => other.into(),
    })
}

/// A sweep with all that it needs.
struct Job<'a> {
    plan: &'a Plan,
    grid: &'a Grid,
    backends: &'a [Backend],
    options: &'a MapOptions,
    store: &'a Store,
    /// Cells a second of one worker, where a sample told.
    rate: Option<f64>,
}

/// Time that a tile takes at least, however often what is done is to be kept.
const SHORTEST_TILE: Duration = Duration::from_millis(500);
/// Cells of the first tile where no sample told how long they take.
const UNKNOWN: usize = 1 << 10;

impl Job<'_> {
    /// Sweeps what is left: the outcomes of all cells, but for a part, which stays on disk.
    fn sweep(
        &self,
        found: Found,
        left: &[Range<usize>],
    ) -> anyhow::Result<(Option<Box<dyn Outcomes>>, Took)> {
        let Job { plan, grid, backends, options, store, .. } = *self;
        let RunOptions { precision, resolve, quiet, .. } = options.run;
        let mut keeper = if options.tile.is_none() && memory::holds(grid) {
            Keeper::in_memory(store, &found.tiles, grid.len(), options.keep_every)?
        } else {
            Keeper::on_disk(store, found.tiles)
        };
        let cells: usize = left.iter().map(Range::len).sum();
        let progress = Progress::new(if resolve { 2 * cells } else { cells }, quiet);
        let advance = |cells| progress.advance(cells);
        let worker = |backend| -> Worker<'_> {
            let backend: &Backend = backend;
            Box::new(move |cells| {
                backend.sweep_range(plan, grid, cells, precision, resolve, &advance)
            })
        };
        let workers: Vec<Worker> = backends.iter().map(worker).collect();
        // Several workers are all to have some, and to end together.
        let most = match workers.len() {
            1 => backends[0].tile(),
            several => backends[0].tile().min(cells.div_ceil(4 * several).max(1)),
        };
        let takes = options.keep_every.max(SHORTEST_TILE);
        // Cells that are slow are to be kept in time, too.
        let first = self.rate.map_or(UNKNOWN, |rate| (rate * takes.as_secs_f64()) as usize);
        let sizes = Sizes { first, most, takes };
        let took = tiles::sweep(&workers, left, sizes, |first, some| keeper.take(first, some));
        progress.finish();
        plan.forget();
        let took = took.inspect_err(|_| {
            // What was done is to be found again; where it cannot be kept, that error was the first.
            let _ = keeper.rescue();
        })?;
        let outcomes = match options.tile {
            None => Some(keeper.finish(grid.len())?),
            Some(_) => None,
        };
        Ok((outcomes, took))
    }
}
