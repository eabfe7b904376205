//! What a map takes of a disk, and what there is.

use std::path::Path;

use topple::results::size::{FileSizes, room};
use topple::sweep::estimate::Estimate;
use topple::sweep::job::Job;

use super::InputError;
use super::map_file::MapFile;
use super::options::MapOptions;

/// Bytes of the pictures, about.
const PICTURES: f64 = 2.0e6;

/// Bytes of a map's files.
pub fn of_files(sizes: &FileSizes, files: &[MapFile]) -> f64 {
    files.iter().map(|file| of_file(sizes, *file)).sum::<f64>() + PICTURES
}

/// Bytes of one of them.
pub fn of_file(sizes: &FileSizes, file: MapFile) -> f64 {
    match file {
        MapFile::Csv => sizes.table,
        MapFile::Npz | MapFile::Mat => sizes.archive,
        MapFile::Zarr => sizes.chunks,
    }
}

/// Most bytes that a run has on disk: its chunks, and beside them its files. A map that is not held in memory
/// is written as map.zarr by giving its chunks that name.
pub fn of_run(job: &Job, estimate: &Estimate, options: &MapOptions) -> f64 {
    let files = options.files(&job.grid);
    let share = job.left() as f64 / job.grid.len() as f64;
    let chunks = (estimate.files.chunks * share).min(job.bytes(job.left()) as f64);
    match options.tile {
        Some(_) => chunks,
        None if files == [MapFile::Zarr] => chunks + PICTURES,
        None => chunks + of_files(&estimate.files, &files),
    }
}

/// Refuses what a directory's disk has not as much room for.
pub fn fits(bytes: f64, out: &Path) -> Result<(), InputError> {
    match room(out) {
        Some(room) if bytes > room as f64 => Err(InputError(format!(
            "--out: the run takes about {} and {} are free; give a directory with more room, or \
             fewer points",
            size(bytes),
            size(room as f64)
        ))),
        _ => Ok(()),
    }
}

/// A size in the unit that a reader would use.
pub fn size(bytes: f64) -> String {
    match bytes {
        b if b < 1.0e9 => format!("{:.0} MB", b / 1.0e6),
        b if b < 1.0e12 => format!("{:.1} GB", b / 1.0e9),
        b => format!("{:.1} TB", b / 1.0e12),
    }
}
