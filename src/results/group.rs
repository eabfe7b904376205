//! The files of a [Zarr group](super::zarr): its documents, and the values of its axes; a list of cells as a group.

use std::io::{self, Write};
use std::path::PathBuf;

use serde_json::Value;

use super::about::Source;
use super::block::Block;
use super::chunk_files::ChunkFiles;
use super::columns::Column;
use super::files::{Directory, WriteError};
use super::listed::{CELL, FileCells};
use super::outcomes::Outcomes;
use super::values::bytes_of;
use super::{chunk, zarr};
use crate::scene::Grid;

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

/// Writes a list of cells as a group in a directory, whole or not at all: arrays of one index, with the numbers of the cells
/// (`cell`) and their counts.
///
/// # Errors
/// [`WriteError`], that of reading the outcomes among them.
pub fn write_list(
    out: &Directory,
    name: &str,
    (listed, outcomes): (FileCells, &dyn Outcomes),
    source: Source,
) -> Result<PathBuf, WriteError> {
    let documents = zarr::documents(listed, &source);
    let tag = documents.last().map_or(0, |(_, group)| crc32c::crc32c(group.to_string().as_bytes()));
    let Source { columns, precision, .. } = source;
    let unread =
        |error: io::Error| WriteError::File { path: out.file(name), reason: error.to_string() };
    out.write_folder(name, |folder| {
        for (path, bytes) in metadata_files(listed.grid, documents, tag) {
            folder.write(&path, |w| w.write_all(&bytes))?;
        }
        let (place, chunking) = (folder.path().to_path_buf(), listed.chunking());
        let files = ChunkFiles { folder: place, chunking, tag, columns, precision };
        let filled_up = |array: &str, chunk: usize, mut bytes: Vec<u8>, size: usize| {
            bytes.resize(size * files.chunking.chunk_cells(), 0);
            files.write_array(folder, array, chunk, &bytes)
        };
        for chunk in 0..files.chunking.count() {
            let cells = files.chunking.cells(chunk);
            let mut block = Block::pending(cells.len(), precision);
            block.put(0, &outcomes.read(cells.clone(), &Column::ALL).map_err(unread)?);
            files.write(folder, chunk, &block, &|| true)?;
            let numbers: Vec<u64> = cells.clone().map(|k| listed.cell(k) as u64).collect();
            filled_up(CELL, chunk, bytes_of(&numbers, u64::to_le_bytes), size_of::<u64>())?;
            for count in listed.counts() {
                let values = bytes_of(&count.values[cells.clone()], u32::to_le_bytes);
                filled_up(count.name, chunk, values, size_of::<u32>())?;
            }
        }
        Ok(())
    })
}
