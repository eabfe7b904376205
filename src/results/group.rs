//! The files of a [Zarr group](super::zarr): its documents, the values of its axes, and the chunks of its columns.

use std::io::{self, Write};
use std::path::PathBuf;

use rayon::prelude::*;
use serde_json::Value;

use super::about::Source;
use super::block::Block;
use super::columns::Column;
use super::files::{Directory, WriteError};
use super::listed::{CELL, ListedCells};
use super::tiling::Tiling;
use super::{tile, zarr};
use crate::scene::Grid;

/// The files of a group, but the chunks of its columns: its documents, and the axes' values.
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
        let packed = tile::pack(&bytes, tag, &path);
        (path, packed)
    });
    documents.chain(axes).collect()
}

/// Where the tiles of a group go.
pub struct TileFiles<'a> {
    /// Its folder.
    pub folder: &'a Directory,
    /// Its tiles.
    pub tiling: &'a Tiling,
    /// What ties them to their run.
    pub tag: u32,
}

impl TileFiles<'_> {
    /// Writes all columns of a tile, the status last, while it is to `go_on`, which is asked before each file; false
    /// where it ended early: the status is not written then.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn write(
        &self,
        tile: usize,
        block: &Block,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, WriteError> {
        let cells = self.tiling.tile_cells();
        let write = |(array, column): (&str, Column)| -> Result<bool, WriteError> {
            if !go_on() {
                return Ok(false);
            }
            self.write_array(array, tile, &tile::encode(array, column, block, cells))?;
            Ok(true)
        };
        let mut arrays: Vec<(&str, Column)> = zarr::columns().collect();
        let status = arrays.pop();
        let written = arrays.into_par_iter().map(write).collect::<Result<Vec<bool>, _>>()?;
        let whole = written.into_iter().all(|written| written);
        match status {
            Some(status) if whole => write(status),
            _ => Ok(whole),
        }
    }

    /// Writes the bytes of an array's chunk.
    fn write_array(&self, array: &str, tile: usize, bytes: &[u8]) -> Result<(), WriteError> {
        let path = zarr::chunk_path(array, self.tiling, tile);
        let packed = tile::pack(bytes, self.tag, &path);
        self.folder.write(&path, |w| w.write_all(&packed))?;
        Ok(())
    }

    /// Writes the whole numbers of a tile's cells, filled up by zeros.
    fn write_counts<const N: usize>(
        &self,
        array: &str,
        tile: usize,
        bytes_of: impl Fn(usize) -> [u8; N],
    ) -> Result<(), WriteError> {
        let mut bytes: Vec<u8> = self.tiling.cells(tile).flat_map(bytes_of).collect();
        bytes.resize(N * self.tiling.tile_cells(), 0);
        self.write_array(array, tile, &bytes)
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
    let tiling = Tiling::of_list(listed.cells.len());
    let unread =
        |error: io::Error| WriteError::File { path: out.file(name), reason: error.to_string() };
    out.write_folder(name, |folder| {
        for (path, bytes) in metadata_files(listed.grid, documents, tag) {
            folder.write(&path, |w| w.write_all(&bytes))?;
        }
        let to = TileFiles { folder, tiling: &tiling, tag };
        for tile in 0..tiling.count() {
            let cells = tiling.cells(tile);
            let mut block = Block::pending(cells.len(), source.precision);
            block.put(0, &listed.outcomes.read(cells, &Column::ALL).map_err(unread)?);
            to.write(tile, &block, &|| true)?;
            to.write_counts(CELL, tile, |k| (listed.cells[k] as u64).to_le_bytes())?;
            for count in listed.counts {
                to.write_counts(count.name, tile, |k| count.values[k].to_le_bytes())?;
            }
        }
        Ok(())
    })
}
