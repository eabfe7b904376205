//! What a map takes of a disk, and what there is.

use std::io::{self, Write};
use std::path::Path;

use topple::map::npz::Source;
use topple::map::outcomes::Outcomes;
use topple::map::{csv, npz};
use topple::scene::Grid;

use super::InputError;

/// Bytes of the pictures, about.
const PICTURES: f64 = 2.0e6;

/// Bytes of a map's files.
#[derive(Debug, Clone, Copy)]
pub struct Files {
    /// map.csv.
    pub table: f64,
    /// map.npz.
    pub archive: f64,
}

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

impl Files {
    /// Of a map of so many cells, from a coarser grid of the same scene.
    pub fn of(
        sample: &Grid,
        outcomes: &dyn Outcomes,
        source: Source,
        cells: usize,
    ) -> anyhow::Result<Files> {
        let mut table = Count::default();
        csv::write(sample, outcomes, &mut table)?;
        let mut archive = io::Cursor::new(Vec::new());
        npz::write(sample, outcomes, source, &mut archive)?;
        let scaled = |bytes: u64| bytes as f64 * cells as f64 / sample.len() as f64;
        Ok(Files { table: scaled(table.0), archive: scaled(archive.into_inner().len() as u64) })
    }

    /// Bytes of all files.
    pub fn all(&self) -> f64 {
        self.table + self.archive + PICTURES
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

/// Room on the disk of a directory, or of the nearest one above that is there, bytes; none where the
/// system does not tell.
pub fn room(directory: &Path) -> Option<u64> {
    let there = std::path::absolute(directory).ok()?;
    let there = there.ancestors().find(|place| place.is_dir())?;
    fs4::available_space(there).ok()
}

/// A size in the unit that a reader would use.
pub fn size(bytes: f64) -> String {
    match bytes {
        b if b < 1.0e9 => format!("{:.0} MB", b / 1.0e6),
        b if b < 1.0e12 => format!("{:.1} GB", b / 1.0e9),
        b => format!("{:.1} TB", b / 1.0e12),
    }
}
