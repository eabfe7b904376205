//! What a map takes of memory, and what there is.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use topple::map::outcomes::DRAWN;
use topple::scene::Grid;
use topple::stepping::outcome::Outcome;
use topple::sweep::backend::Backend;

use super::InputError;
use super::options::MapOptions;

/// Memory that a cell takes beside its outcome: its number and its share of what the threads hold.
const BYTES_A_CELL: usize = 40;
/// Most cells of a map that is held in memory; a larger one lies on disk and is read as it is needed.
const MOST_HELD: usize = 1 << 24;
/// Tiles that there are at once: one that a worker runs, and those that are kept or wait for it.
const TILES: usize = 5;
/// Memory that the motions in full contact may take, bytes.
const MOTIONS: usize = 512 << 20;

/// Memory that so many cells in memory take, bytes.
pub fn of_cells(cells: usize) -> u64 {
    cells as u64 * (size_of::<Outcome>() + BYTES_A_CELL) as u64
}

/// True where a map is held in memory until it is written: it is no huge one, and half of what is
/// free is enough for it.
pub fn holds(grid: &Grid) -> bool {
    let available = available();
    grid.len() <= MOST_HELD && (available == 0 || of_cells(grid.len()) <= available / 2)
}

/// Most memory that a run takes, bytes: that of a map's cells if it is held in memory, or else of what
/// is drawn of it, unless it is a part; and of the tiles at work, twice where each cell runs twice.
pub fn of_run(grid: &Grid, options: &MapOptions, workers: &[Backend]) -> u64 {
    let runs = if options.run.resolve { 2 } else { 1 };
    let tiles = TILES * workers.iter().map(Backend::tile).sum::<usize>() * runs;
    let (columns, rows) = grid.shape();
    let kept = match options.tile {
        Some(_) => 0,
        None if holds(grid) => grid.len(),
        None => columns.min(DRAWN) * rows.min(DRAWN),
    };
    of_cells(kept + tiles.min(grid.len())) + MOTIONS as u64
}

/// Memory that is free, bytes; zero where the machine does not tell.
fn available() -> u64 {
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    System::new_with_specifics(memory).map_or(0, |system| system.available_memory())
}

/// Refuses what needs more memory than is free; `what` names flags and cells.
pub fn fits(needed: u64, what: &str) -> Result<(), InputError> {
    let available = available();
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
