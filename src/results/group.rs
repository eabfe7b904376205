//! The files of a [Zarr group](super::zarr): its documents, the values of its axes, and the chunks of its cells.

use std::io::{self, Write};
use std::path::PathBuf;

use serde_json::Value;

use super::about::Source;
use super::block::Block;
use super::chunking::Chunking;
use super::column_set::ColumnSet;
use super::columns::Column;
use super::files::{Directory, WriteError};
use super::listed::{CELL, ListedCells};
use super::{chunk, zarr};
use crate::scene::Grid;
use crate::work::parallel;

/// The files of a group, but those of its chunks: its documents, and the axes' values.
pub fn metadata_files(
    grid: &Grid,
    documents: Vec<(String, Value)>,
    tag: u32,
) -> Vec<(String, Vec<u8>)> {
    let documents = documents.into_iter().map(|(path, document)| {
        // A JSON value with text keys always has a text.
        (path, format!("{document:#}").into_bytes())
    });
    let axes = grid.axes().iter().map(|axis| {
        let (path, bytes) = zarr::axis_chunk(axis);
        let packed = chunk::pack(&bytes, tag, &path);
        (path, packed)
    });
    documents.chain(axes).collect()
}

/// Where the chunks of a group go.
pub struct ChunkFiles<'a> {
    /// Its folder.
    pub folder: &'a Directory,
    /// Its chunks.
    pub chunking: &'a Chunking,
    /// What ties them to their run.
    pub tag: u32,
    /// The requested columns.
    pub columns: ColumnSet,
}

impl ChunkFiles<'_> {
    /// Writes the columns of a chunk, the status last, while it is to `go_on`, which is asked before each file; false
    /// where it ended early: the status is not written then.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn write(
        &self,
        chunk: usize,
        block: &Block,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, WriteError> {
        let cells = self.chunking.chunk_cells();
        let write = |(array, column): (&str, Column)| -> Result<bool, WriteError> {
            if !go_on() {
                return Ok(false);
            }
            self.write_array(array, chunk, &chunk::encode(array, column, block, cells))?;
            Ok(true)
        };
        let mut arrays: Vec<(&str, Column)> = zarr::columns(self.columns).collect();
        let status = arrays.pop();
        let written = parallel::each(arrays.len(), 1, |number| write(arrays[number]));
        let written = written.into_iter().collect::<Result<Vec<bool>, _>>()?;
        let whole = written.into_iter().all(|written| written);
        match status {
            Some(status) if whole => write(status),
            _ => Ok(whole),
        }
    }

    /// Writes the bytes of a chunk in an array.
    fn write_array(&self, array: &str, chunk: usize, bytes: &[u8]) -> Result<(), WriteError> {
        let path = zarr::chunk_path(array, self.chunking, chunk);
        let packed = chunk::pack(bytes, self.tag, &path);
        self.folder.write(&path, |w| w.write_all(&packed))?;
        Ok(())
    }

    /// Writes the whole numbers of a chunk's cells, filled up by zeros.
    fn write_counts<const N: usize>(
        &self,
        array: &str,
        chunk: usize,
        bytes_of: impl Fn(usize) -> [u8; N],
    ) -> Result<(), WriteError> {
        let mut bytes: Vec<u8> = self.chunking.cells(chunk).flat_map(bytes_of).collect();
        bytes.resize(N * self.chunking.chunk_cells(), 0);
        self.write_array(array, chunk, &bytes)
    }
}

/// Writes some cells as a group in a directory, whole or not at all: arrays of one index, with the numbers of the cells
/// (`cell`) and their counts.
///
/// # Errors
/// [`WriteError`], that of reading the outcomes among them.
pub fn write_list(
    out: &Directory,
    name: &str,
    listed: &ListedCells,
    source: Source,
) -> Result<PathBuf, WriteError> {
    let documents = zarr::list_documents(listed, &source);
    let tag = documents.last().map_or(0, |(_, group)| crc32c::crc32c(group.to_string().as_bytes()));
    let chunking = Chunking::of_list(listed.cells.len());
    let unread =
        |error: io::Error| WriteError::File { path: out.file(name), reason: error.to_string() };
    out.write_folder(name, |folder| {
        for (path, bytes) in metadata_files(listed.grid, documents, tag) {
            folder.write(&path, |w| w.write_all(&bytes))?;
        }
        let to = ChunkFiles { folder, chunking: &chunking, tag, columns: source.columns };
        for chunk in 0..chunking.count() {
            let cells = chunking.cells(chunk);
            let mut block = Block::pending(cells.len(), source.precision);
            block.put(0, &listed.outcomes.read(cells, &Column::ALL).map_err(unread)?);
            to.write(chunk, &block, &|| true)?;
            to.write_counts(CELL, chunk, |k| (listed.cells[k] as u64).to_le_bytes())?;
            for count in listed.counts {
                to.write_counts(count.name, chunk, |k| count.values[k].to_le_bytes())?;
            }
        }
        Ok(())
    })
}
