//! The files of the chunks of a [Zarr group](super::zarr): those of a chunk are written together, the status last, and read
//! one by one.

use std::io::{self, ErrorKind, Write};
use std::ops::Range;
use std::path::PathBuf;

use super::block::Block;
use super::chunk::{self, Fault};
use super::chunking::Chunking;
use super::column_set::ColumnSet;
use super::columns::Column;
use super::files::{Directory, WriteError};
use super::store_error::StoreError;
use super::values::ColumnValues;
use super::zarr::{self, PROVED};
use crate::model::precision::Precision;
use crate::scene::bounded;
use crate::work::parallel;

/// Where the chunks of a group are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChunkFiles {
    /// Its folder.
    pub folder: PathBuf,
    /// Its chunks.
    pub chunking: Chunking,
    /// What ties them to their run.
    pub tag: u32,
    /// The requested columns.
    pub columns: ColumnSet,
    /// The number type of its columns.
    pub precision: Precision,
}

/// A chunk of which cells were saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedChunk {
    /// Its number.
    pub chunk: usize,
    /// The runs of cells that have run.
    pub done: Vec<Range<usize>>,
}

/// A chunk that was found: the cells of it that have run; or of one that is broken the files that must go, each
/// with what is wrong, that of the status among them.
type Found = Result<SavedChunk, Vec<(PathBuf, Fault)>>;

impl ChunkFiles {
    /// Writes the columns of a chunk, the status last, while it is to `go_on`, which is asked before each file; false
    /// where it ended early: the status is not written then.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn write(
        &self,
        to: &Directory,
        chunk: usize,
        block: &Block,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, WriteError> {
        let cells = self.chunking.chunk_cells();
        let write = |(array, column): (&str, Column)| -> Result<bool, WriteError> {
            if !go_on() {
                return Ok(false);
            }
            self.write_array(to, array, chunk, &chunk::encode(array, column, block, cells))?;
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
    pub(super) fn write_array(
        &self,
        to: &Directory,
        array: &str,
        chunk: usize,
        bytes: &[u8],
    ) -> Result<(), WriteError> {
        let name = zarr::chunk_path(array, &self.chunking, chunk);
        let packed = chunk::pack(bytes, self.tag, &name);
        to.write(&name, |w| w.write_all(&packed))?;
        Ok(())
    }

    /// The path of a chunk's file in an array.
    fn path(&self, array: &str, chunk: usize) -> PathBuf {
        self.folder.join(zarr::chunk_path(array, &self.chunking, chunk))
    }

    /// The values of a column of a chunk that was found whole.
    ///
    /// # Errors
    /// Errors of the disk, with the file's name; [`ErrorKind::InvalidData`] of a file that is not whole any more.
    pub fn column(&self, chunk: usize, column: Column) -> io::Result<ColumnValues> {
        let (name, cells) = (column.entry().name, self.chunking.chunk_cells());
        let error = |array: &str, kind, problem: &dyn std::fmt::Display| {
            io::Error::new(kind, format!("{}: {problem}", self.path(array, chunk).display()))
        };
        let damaged =
            |array: &str| error(array, ErrorKind::InvalidData, &"damaged since it was found");
        let bytes = |array: &str| {
            let packed = bounded::read(&self.path(array, chunk), chunk::LARGEST)
                .map_err(|e| error(array, e.kind(), &e))?;
            let count = chunk::bytes_of(array, column, self.precision, cells);
            chunk::unpack(&packed, count).ok_or_else(|| damaged(array))
        };
        let proved = if column == Column::Status { bytes(PROVED)? } else { Vec::new() };
        let count = self.chunking.cells(chunk).len();
        chunk::decode((column, self.precision), count, &bytes(name)?, &proved)
            .ok_or_else(|| damaged(name))
    }

    /// The columns of a chunk that was found whole. Those that are not held have what tells that they are not known.
    ///
    /// # Errors
    /// Those of [`ChunkFiles::column`].
    pub fn read(&self, chunk: usize) -> io::Result<Block> {
        let mut block = Block::pending(0, self.precision);
        for column in self.columns.held().columns() {
            block.replace(column, self.column(chunk, column)?);
        }
        Ok(block)
    }

    /// Finds a chunk, if its status is there.
    pub(super) fn find(&self, chunk: usize) -> Result<Option<Found>, StoreError> {
        let status = self.path(Column::Status.entry().name, chunk);
        if !status.exists() {
            return Ok(None);
        }
        let mut broken = Vec::new();
        for (array, column) in zarr::columns(self.columns) {
            let (path, name) =
                (self.path(array, chunk), zarr::chunk_path(array, &self.chunking, chunk));
            match bounded::read(&path, chunk::LARGEST) {
                Ok(bytes) => {
                    let cells = self.chunking.chunk_cells();
                    let count = chunk::bytes_of(array, column, self.precision, cells);
                    let fault = match chunk::check(&bytes, self.tag, &name) {
                        Ok(()) if chunk::held(&bytes) != Some(count) => Some(Fault::OtherType),
                        checked => checked.err(),
                    };
                    broken.extend(fault.map(|fault| (path, fault)));
                }
                Err(e) if e.kind() == ErrorKind::NotFound => broken.push((path, Fault::Missing)),
                Err(e) => return Err(StoreError::file(&path)(e)),
            }
        }
        if broken.is_empty() {
            match self.column(chunk, Column::Status) {
                Ok(codes) => {
                    let first = self.chunking.cells(chunk).start;
                    let at = |run: Range<usize>| first + run.start..first + run.end;
                    let done = codes.done().into_iter().map(at).collect();
                    return Ok(Some(Ok(SavedChunk { chunk, done })));
                }
                Err(e) if e.kind() == ErrorKind::InvalidData => {
                    broken.push((status.clone(), Fault::Damaged));
                }
                Err(e) => return Err(StoreError::file(&status)(e)),
            }
        }
        if broken.iter().all(|(path, _)| *path != status) {
            broken.push((status, Fault::OfItsChunk));
        }
        Ok(Some(Err(broken)))
    }
}
