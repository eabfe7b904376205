//! How large a map's files will be, from a sample of it, and how much room a disk has.

use std::io::{self, Write};
use std::path::Path;

use super::about::Source;
use super::block::Block;
use super::columns::Column;
use super::outcomes::Outcomes;
use super::{chunk, csv, npz, zarr};
use crate::scene::Grid;

/// Bytes of a map's files.
#[derive(Debug, Clone, Copy)]
pub struct FileSizes {
    /// map.csv.
    pub table: f64,
    /// map.npz.
    pub archive: f64,
    /// Chunks on disk, and map.zarr.
    pub chunks: f64,
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

impl FileSizes {
    /// Of a map of a given number of cells, from a coarser grid of the same scene.
    ///
    /// # Errors
    /// Those of reading the outcomes.
    pub fn of(
        sample: &Grid,
        outcomes: &dyn Outcomes,
        source: Source,
        cells: usize,
    ) -> io::Result<FileSizes> {
        let mut table = Count::default();
        csv::write(sample, outcomes, source.columns, &mut table).map_err(io::Error::other)?;
        let mut archive = io::Cursor::new(Vec::new());
        npz::write(sample, outcomes, source, &mut archive)?;
        let mut block = Block::pending(sample.len(), source.precision);
        block.put(0, &outcomes.read(0..sample.len(), &Column::ALL)?);
        let packed = |(name, column)| {
            chunk::pack(&chunk::encode(name, column, &block, sample.len()), 0, name).len() as u64
        };
        let chunks = zarr::columns(source.columns).map(packed).sum();
        let scaled = |bytes: u64| bytes as f64 * cells as f64 / sample.len() as f64;
        let archive = archive.into_inner().len() as u64;
        Ok(FileSizes { table: scaled(table.0), archive: scaled(archive), chunks: scaled(chunks) })
    }
}

/// Room on the disk of a directory, or of the nearest one above that is there, bytes; none where the
/// system does not tell.
pub fn room(directory: &Path) -> Option<u64> {
    let there = std::path::absolute(directory).ok()?;
    let there = there.ancestors().find(|place| place.is_dir())?;
    fs4::available_space(there).ok()
}
