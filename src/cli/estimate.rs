//! What a run will take, from a sample of it: said before it starts, and all that `--dry-run` does.

use std::ops::Range;
use std::time::Duration;

use topple::map::npz::Source;
use topple::scene::{Grid, Parameter};
use topple::store::tile;
use topple::sweep::backend::Backend;
use topple::sweep::plan::Plan;

use super::disk::{self, Files, size};
use super::options::{MapOptions, flag_error};
use super::{memory, words};

/// Most points of an axis of the sample, and the least.
const SIDE: [f64; 2] = [16.0, 96.0];
/// Cells of a run for each one of its sample.
const SHARE: f64 = 100.0;
/// Cells of a run that is over before a sample of it would be.
const SMALL: usize = 10_000;

/// What a run takes.
struct Estimate {
    /// Cells of the sample.
    sampled: usize,
    /// Cells a second of one worker.
    rate: f64,
    /// Time of compiling the shader.
    compile: Duration,
    /// Bytes of the map's files.
    files: Files,
    /// Most bytes on disk while it runs and while its files are written.
    disk: f64,
}

impl Estimate {
    /// Of `cells` cells of a grid, from a coarser grid of the same scene.
    fn of(
        plan: &Plan,
        grid: &Grid,
        options: &MapOptions,
        backend: &Backend,
        cells: usize,
    ) -> anyhow::Result<Estimate> {
        let mut sample = plan.scene.clone();
        let side = (cells as f64 / SHARE).sqrt().clamp(SIDE[0], SIDE[1]);
        let swept = sample.swept();
        // As many cells as a square has, by as many axes as there are.
        let most = side.powf(2.0 / swept.len().max(1) as f64).max(2.0) as usize;
        for parameter in swept {
            if let Some(values) = sample.numbers.get(parameter) {
                let thinned = values.thinned(most);
                sample.set(parameter, thinned);
            }
        }
        let sample_plan = options.run.plan(&sample).map_err(|e| flag_error(&e))?;
        let sample = Grid::of(&sample);
        let (precision, resolve) = (options.run.precision, options.run.resolve);
        let all = 0..sample.len();
        let swept = backend.sweep_range(&sample_plan, &sample, all, precision, resolve, &|_| ())?;
        let outcomes = swept.outcomes;
        let files =
            Files::of(&sample, &outcomes, Source { scene: &plan.scene, precision }, grid.len())?;
        // A part leaves tiles and no more.
        let written = if options.tile.is_some() { 0.0 } else { files.all() };
        let rate = sample.len() as f64 / swept.elapsed.as_secs_f64().max(1.0e-9);
        let disk = written + (tile::CELL * cells) as f64;
        Ok(Estimate { sampled: sample.len(), rate, compile: swept.compile, files, disk })
    }
}

/// Says what a run takes, and runs no more than the sample.
pub fn tell(
    plan: &Plan,
    grid: &Grid,
    options: &MapOptions,
    wanted: &Range<usize>,
) -> anyhow::Result<()> {
    let backends = options.run.open_backends()?;
    // A request opens one backend at least.
    let backend = &backends[0];
    let takes = Estimate::of(plan, grid, options, backend, wanted.len())?;
    let part = match options.tile {
        None => String::new(),
        Some(part) => format!(", part {part} of them {}", wanted.len()),
    };
    println!("cells      {} = {}{part}", words::sides(grid), grid.len());
    println!("motion     {:.3e} s simulated at the most", motion(plan, wanted.len()));
    println!(
        "time       about {} of sweep by {} {}, {:.0} cells/s on {} cells",
        duration(wanted.len() as f64 / takes.rate / backends.len() as f64),
        backend.name(),
        options.run.precision.name(),
        takes.rate * backends.len() as f64,
        takes.sampled
    );
    let bytes = memory::of_run(grid, options, &backends) as f64;
    println!("memory     up to {}", size(bytes));
    let tiles = (tile::CELL * wanted.len()) as f64;
    let files = if options.tile.is_some() {
        format!("{} of tiles", size(tiles))
    } else {
        let Files { table, archive } = takes.files;
        let (all, table, archive) = (size(takes.files.all()), size(table), size(archive));
        format!(
            "{all}: map.csv {table}, map.npz {archive}; up to {} while it runs",
            size(takes.disk)
        )
    };
    let room = match disk::room(&options.run.out) {
        Some(room) => format!("; {} are free", size(room as f64)),
        None => String::new(),
    };
    println!("disk       {files}{room}");
    Ok(())
}

/// What a run takes that is about to start.
pub struct Takes {
    /// In a line.
    pub line: String,
    /// Time that the sample spent on compiling the shader, which the run need not spend again.
    pub compile: Duration,
    /// Cells a second of one worker, where a sample told.
    pub rate: Option<f64>,
}

/// What a run takes that is about to start, with `left` cells to run.
///
/// # Errors
/// An [`InputError`](super::InputError) where the disk has not as much room.
pub fn before(
    plan: &Plan,
    grid: &Grid,
    options: &MapOptions,
    backends: &[Backend],
    left: usize,
) -> anyhow::Result<Takes> {
    let motion = format!("{left} cells, {:.2e} s of motion at the most", motion(plan, left));
    if left < SMALL {
        return Ok(Takes { line: motion, compile: Duration::ZERO, rate: None });
    }
    let takes = Estimate::of(plan, grid, options, &backends[0], left)?;
    disk::fits(takes.disk, &options.run.out)?;
    let time = left as f64 / takes.rate / backends.len() as f64;
    let line = format!("{motion}, about {}, up to {} of disk", duration(time), size(takes.disk));
    Ok(Takes { line, compile: takes.compile, rate: Some(takes.rate) })
}

/// Time that cells simulate if none ends early, s.
fn motion(plan: &Plan, cells: usize) -> f64 {
    let longest = plan.scene.numbers.get(Parameter::TMax).map_or(0.0, |t_max| t_max.ends().1);
    cells as f64 * longest
}

/// A time in the unit that a reader would use.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".into(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
