//! `--dry-run`: what a map would take.

use std::io::{self, Write};

use topple::map::{self, Map};
use topple::scene::{Grid, Scene};
use topple::sweep::plan::Plan;

use super::options::{RunOptions, flag_error};
use super::report;

/// Points of an axis of the sample.
const SIDE: u32 = 96;
/// Bytes of the pictures, about.
const PICTURES: f64 = 1.0e6;

/// Counts what is written to it.
#[derive(Default)]
struct Count(u64);

impl Write for Count {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Says what a map takes; times and sizes are those of a sample, a coarser map of the same scene.
pub fn tell(scene: &Scene, plan: &Plan, grid: &Grid, options: &RunOptions) -> anyhow::Result<()> {
    let mut sample = scene.clone();
    for axis in sample.axes_mut() {
        axis.count = axis.count.min(SIDE);
    }
    let sample_grid = Grid::of(&sample);
    let sample_plan = options.plan(&sample).map_err(|e| flag_error(&e))?;
    let backend = options.open_backend()?;
    let precision = options.precision;
    let cells = 0..sample_grid.len();
    let resolve = options.resolve;
    let swept =
        backend.sweep_range(&sample_plan, &sample_grid, cells, precision, resolve, &|_| ())?;
    let rate = sample_grid.len() as f64 / swept.elapsed.as_secs_f64().max(1.0e-9);
    let map = Map { scene: &sample, grid: sample_grid, outcomes: swept.outcomes };
    let mut table = Count::default();
    map::csv::write(&map, &mut table)?;
    let mut archive = io::Cursor::new(Vec::new());
    map::npz::write(&map, &mut archive)?;
    let (columns, rows) = grid.shape();
    let cells = grid.len() as f64;
    let scaled = |bytes: u64| cells * bytes as f64 / sample_grid.len() as f64;
    let (table, archive) = (scaled(table.0), scaled(archive.into_inner().len() as u64));
    let giga = |bytes: f64| bytes / 1.0e9;
    println!("cells      {columns} x {rows} = {}", grid.len());
    println!("motion     {:.3e} s simulated at the most", cells * scene.t_max);
    println!(
        "time       about {:.0} s of sweep by {} {}, {rate:.0} cells/s on {} cells",
        cells / rate,
        backend.name(),
        precision.name(),
        sample_grid.len()
    );
    let memory = report::memory_of(grid.len(), report::held(plan, options));
    println!("memory     {:.2} GB", giga(memory as f64));
    println!(
        "disk       {:.2} GB: map.csv {:.2}, map.npz {:.2}; up to {:.2} while it runs",
        giga(table + archive + PICTURES),
        giga(table),
        giga(archive),
        giga(table + archive + PICTURES + topple::store::tile::CELL as f64 * cells)
    );
    Ok(())
}
