//! A map from scene to files, and what is said about it.

use std::path::Path;
use std::time::Instant;

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use topple::integrate::outcome::Outcome;
use topple::map::Map;
use topple::map::figure::frame;
use topple::map::files::Directory;
use topple::map::manifest::{self, Manifest, Reduced, Steps, Timings};
use topple::scene::{Excitation, Grid, Scene};
use topple::store::identity::{Identity, Manner};
use topple::store::{self, Found, Store, StoreError};
use topple::sweep::backend::Backend;
use topple::sweep::plan::Plan;
use topple::sweep::tiles::Run;
use topple::sweep::verification;

use super::options::{MapOptions, RunOptions, flag_error};
use super::progress::Progress;
use super::{InputError, dry_run, output, words};

/// Memory that a cell takes beside its outcome: its number, a column of the archive, its row of the
/// picture, and its share of what the threads hold.
const BYTES_A_CELL: usize = 40;

/// Runs a scene's map and writes its files.
pub fn run_map(scene: &Scene, options: &MapOptions) -> anyhow::Result<()> {
    let MapOptions { run: options, resume, keep_every, dry_run } = options;
    let plan = options.plan(scene).map_err(|e| flag_error(&e))?;
    let grid = Grid::of(scene);
    if *dry_run {
        return dry_run::tell(scene, &plan, &grid, options);
    }
    check_memory(&grid, held(&plan, options))?;
    let out = open(&options.out)?;
    let began = Instant::now();
    let backend = options.open_backend()?;
    let opened = began.elapsed();
    let (store, found) = unfinished(scene, &backend, options, *resume)?;
    let say = |line: String| {
        if !options.quiet {
            println!("{line}");
        }
    };
    let (columns, rows) = grid.shape();
    say(format!("scene      {}, {columns} x {rows} cells", scene.title));
    say(format!("           {}", frame::caption(scene)));
    if let Excitation::Record(pair) = &scene.excitation {
        say(format!("record     {}, {} samples at {} s", pair.title, pair.len(), pair.dt));
        for note in &pair.notes {
            say(format!("           {note}"));
        }
    }
    say(format!("backend    {}", words::backend(&backend, options.precision.name())));
    say(format!("model      {}", words::model(&plan)));
    for broken in &found.broken {
        say(format!("again      {broken}"));
    }
    let mut outcomes = vec![Outcome::PENDING; grid.len()];
    let missing = store::missing(&found.tiles, grid.len());
    for tile in &found.tiles {
        // The identity has the grid: no tile reaches beyond it.
        outcomes[tile.cells()].copy_from_slice(&tile.outcomes);
    }
    let left: usize = missing.iter().map(|cells| cells.len()).sum();
    if left < grid.len() {
        say(format!("resumed    {} of {} cells were done", grid.len() - left, grid.len()));
    }
    drop(found);
    let runs = if options.resolve { 2 } else { 1 };
    let progress = Progress::new(runs * left, options.quiet);
    let run = Run {
        backend: &backend,
        plan: &plan,
        grid: &grid,
        precision: options.precision,
        resolve: options.resolve,
        patience: *keep_every,
        progress: &|cells| progress.advance(cells),
    };
    let swept = run.fill(&mut outcomes, &missing, |first, cells| store.keep(first, cells));
    progress.finish();
    let swept = match swept {
        Ok(swept) => swept,
        Err(error) => {
            store.discard_if_empty()?;
            return Err(error.into());
        }
    };
    let seconds = swept.elapsed.as_secs_f64();
    let rate = left as f64 / seconds.max(1.0e-9);
    say(format!("sweep      {seconds:.2} s, {rate:.0} cells/s"));
    let map = Map { scene, grid, outcomes };
    say(format!("outcomes   {}", words::shares(&map)));
    let judged = Instant::now();
    let verification = verification::verify(&plan, &grid, &map.outcomes, verification::SAMPLE);
    let timings = Timings {
        start: (opened + swept.compile).as_secs_f64(),
        sweep: seconds,
        verification: judged.elapsed().as_secs_f64(),
    };
    say(format!("reference  {}", words::agreement(&verification)));
    let steps = steps(&plan.at(options.precision), &grid);
    let manifest = Manifest {
        version: env!("CARGO_PKG_VERSION"),
        scene,
        cells: grid.len(),
        resumed_cells: grid.len() - left,
        backend: backend.name(),
        adapter: backend.adapter(),
        threads: threads(),
        precision: options.precision,
        resolve: options.resolve,
        steps,
        timings,
        cells_per_second: rate,
        outcomes: manifest::outcomes(&map),
        tensile_cells: map.tensile(),
        sliding_cells: map.sliding(),
        model: Reduced::of(&plan, &map),
        verification: &verification,
    };
    let picture = output::write(&out, &map, &manifest)?;
    store.discard()?;
    say(format!("picture    {}", picture.display()));
    say(format!("data       {} with map.npz, map.svg, run.json", out.file("map.csv").display()));
    Ok(())
}

/// Outcomes a cell that are held at once: two sweeps beside each other, and parts until they are put
/// in order.
pub fn held(plan: &Plan, options: &RunOptions) -> usize {
    if options.resolve || plan.rigid_period().is_some() { 2 } else { 1 }
}

/// Memory that so many cells take, bytes.
pub fn memory_of(cells: usize, held: usize) -> u64 {
    cells as u64 * (held * size_of::<Outcome>() + BYTES_A_CELL) as u64
}

/// The folder in which the run keeps what is done, and what an earlier one left there.
fn unfinished(
    scene: &Scene,
    backend: &Backend,
    options: &RunOptions,
    resume: bool,
) -> anyhow::Result<(Store, Found)> {
    let manner = Manner {
        precision: options.precision,
        largest_step: options.step,
        resolve: options.resolve,
        full_model: options.full_model,
    };
    let identity = Identity::new(scene, backend, &manner)?;
    Store::open(&options.out, identity, resume).map_err(|error| match error {
        StoreError::InUse(_) | StoreError::Unfinished(_) | StoreError::Other { .. } => {
            InputError(format!("--out: {error}")).into()
        }
        other => other.into(),
    })
}

/// Opens the directory for the results.
pub fn open(out: &Path) -> Result<Directory, InputError> {
    Directory::open(out).map_err(|error| InputError(format!("--out: {error}")))
}

/// Threads that a sweep on the CPU takes.
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn check_memory(grid: &Grid, held: usize) -> Result<(), InputError> {
    let (columns, rows) = grid.shape();
    let flag = |key: &str| key.replace('_', "-");
    let (x, y) = (flag(grid.x.key), flag(grid.y.key));
    fits(memory_of(grid.len(), held), &format!("--{x}, --{y}: {columns} x {rows} cells"))
}

/// Refuses what needs more memory than is free; `what` names flags and cells.
pub fn fits(needed: u64, what: &str) -> Result<(), InputError> {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let available =
        System::new_with_specifics(memory).map_or(0, |system| system.available_memory());
    // A machine that does not tell has the benefit of the doubt.
    if available == 0 || needed <= available {
        return Ok(());
    }
    let giga = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    Err(InputError(format!(
        "{what} take {:.1} GiB and {:.1} GiB are free; give fewer points",
        giga(needed),
        giga(available)
    )))
}

fn steps(plan: &Plan, grid: &Grid) -> Steps {
    let mut steps =
        Steps { largest: plan.resolution.largest_step, shortest: f64::INFINITY, most: 0 };
    for index in 0..grid.len() {
        let clock = plan.clock(&grid.point(index));
        let step = if clock.step_free > 0.0 { clock.step_free } else { clock.step_forced };
        steps.shortest = steps.shortest.min(step);
        steps.most = steps.most.max(clock.steps);
    }
    steps
}
