//! What a map takes of memory, and what there is.

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use topple::backend::ready::Backend;
use topple::model::precision::Precision;
use topple::results::block::bytes_a_cell;
use topple::scene::{Grid, Scene};
use topple::stepping::outcome::Outcome;
use topple::sweep::job::Job;
use topple_pictures::map::thinned::DRAWN;

use super::InputError;

/// Memory that a cell of a batch takes: its outcome, its number, its share of what the threads hold.
const BYTES_A_CELL: usize = size_of::<Outcome>() + 40;
/// Most cells of a map that is held in memory; a larger one lies on disk and is read as it is needed.
const MOST_HELD: usize = 1 << 24;
/// Batches that there are at once: one that a worker runs, and those that are saved or wait for it.
const BATCHES: usize = 5;
/// Memory that the program takes without a map, bytes: above all for the pictures, of which several are drawn at once.
const PROGRAM: usize = 160 << 20;

/// Memory that so many cells of a batch take, bytes.
pub fn of_cells(cells: usize) -> u64 {
    (cells * BYTES_A_CELL) as u64
}

/// Memory that a scene's map may take for its columns, bytes: half of what is free, and no more than those
/// of a huge map.
pub fn for_columns(scene: &Scene, precision: Precision) -> u64 {
    let cells = Grid::of(scene).len().min(MOST_HELD);
    let most = cells as u64 * bytes_a_cell(precision) as u64;
    match available() {
        0 => most,
        available => most.min(available / 2),
    }
}

/// Most memory that a run takes, bytes: that of a map's columns if it is held in memory, or else of what
/// is drawn of it, unless it is a shard; of the batches at work, twice where each cell runs twice; and of the motions that cells
/// share.
pub fn of_run(job: &Job, (shard, twice): (bool, bool)) -> u64 {
    let runs = if twice { 2 } else { 1 };
    let batches = BATCHES * job.backends().iter().map(Backend::batch).sum::<usize>() * runs;
    let grid = &job.grid;
    let (columns, rows) = grid.shape();
    let most = for_columns(&job.plan.scene, job.method().precision);
    let kept = match shard {
        true => 0,
        false if job.bytes(grid.len()) <= most => job.bytes(grid.len()),
        false => of_cells(columns.min(DRAWN) * rows.min(DRAWN)),
    };
    let shared = (job.bytes_shared() + PROGRAM) as u64;
    kept + of_cells(batches.min(grid.len())) + shared
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
