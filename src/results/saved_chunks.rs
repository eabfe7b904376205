//! What an earlier run left in its folder: chunks, and the cells of them that have run.

use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::chunk::Fault;
use super::chunking::Chunking;
use super::column_set::ColumnSet;
use super::columns::Column;
use super::store_error::StoreError;
use super::{chunk, zarr};
use crate::model::precision::Precision;
use crate::scene::bounded;
use crate::work::parallel;

/// A chunk of which cells were saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedChunk {
    /// Its number.
    pub chunk: usize,
    /// The runs of cells that have run.
    pub done: Vec<Range<usize>>,
}

/// What an earlier run left.
#[derive(Debug, Default)]
pub struct SavedChunks {
    /// Its whole chunks.
    pub chunks: Vec<SavedChunk>,
    /// Files that are not whole, and whose chunks are run again: each with what is wrong.
    pub broken: Vec<(PathBuf, Fault)>,
}

impl SavedChunks {
    /// The chunks in a folder of an identity's tag and the requested columns, in their number type; `progress` hears of the cells
    /// of each.
    ///
    /// # Errors
    /// Errors of the disk.
    pub fn in_folder(
        folder: &Path,
        chunking: &Chunking,
        of: (u32, ColumnSet, Precision),
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<SavedChunks, StoreError> {
        let chunks = parallel::each(chunking.count(), 1, |chunk| {
            let found = find(folder, chunking, chunk, of);
            if let Ok(Some(Ok(saved))) = &found {
                progress(saved.done.iter().map(Range::len).sum());
            }
            found
        });
        let mut found = SavedChunks::default();
        for chunk in chunks {
            match chunk? {
                None => {}
                Some(Ok(saved)) => found.chunks.push(saved),
                Some(Err(broken)) => found.broken.extend(broken),
            }
        }
        Ok(found)
    }

    /// The runs of cells that have run.
    pub fn done(&self) -> Vec<Range<usize>> {
        self.chunks.iter().flat_map(|saved| saved.done.iter().cloned()).collect()
    }
}

/// A chunk in a folder: the cells of it that have run; or of one that is broken the files that must go, each
/// with what is wrong, that of the status among them.
type Chunk = Result<SavedChunk, Vec<(PathBuf, Fault)>>;

/// Finds a chunk in a folder, if its status is there.
fn find(
    folder: &Path,
    chunking: &Chunking,
    chunk: usize,
    (tag, columns, precision): (u32, ColumnSet, Precision),
) -> Result<Option<Chunk>, StoreError> {
    let name = |array: &str| zarr::chunk_path(array, chunking, chunk);
    let path = |array: &str| folder.join(name(array));
    let status = path(Column::Status.entry().name);
    if !status.exists() {
        return Ok(None);
    }
    let mut broken = Vec::new();
    for (array, column) in zarr::columns(columns) {
        let path = path(array);
        match bounded::read(&path, chunk::LARGEST) {
            Ok(bytes) => {
                let count = chunk::bytes_of(array, column, precision, chunking.chunk_cells());
                let fault = match chunk::check(&bytes, tag, &name(array)) {
                    Ok(()) if chunk::held(&bytes) != Some(count) => Some(Fault::OtherType),
                    checked => checked.err(),
                };
                broken.extend(fault.map(|fault| (path, fault)));
            }
            Err(e) if e.kind() == ErrorKind::NotFound => broken.push((path, Fault::Missing)),
            Err(e) => return Err(StoreError::file(&path)(e)),
        }
    }
    let (cells, whole) = (chunking.cells(chunk), chunking.chunk_cells());
    let codes = || -> Result<Option<Vec<Range<usize>>>, StoreError> {
        let mut arrays = |array: &str, count| {
            let path = path(array);
            let packed = bounded::read(&path, chunk::LARGEST).map_err(StoreError::file(&path))?;
            Ok(chunk::unpack(&packed, count))
        };
        let (of, sizes) = ((Column::Status, precision), (cells.len(), whole));
        let codes = chunk::decode::<StoreError>(of, sizes, &mut arrays)?;
        Ok(codes.map(|codes| codes.done()))
    };
    if broken.is_empty() {
        if let Some(done) = codes()? {
            let at = |run: Range<usize>| cells.start + run.start..cells.start + run.end;
            return Ok(Some(Ok(SavedChunk { chunk, done: done.into_iter().map(at).collect() })));
        }
        broken.push((status.clone(), Fault::Damaged));
    }
    if broken.iter().all(|(path, _)| *path != status) {
        broken.push((status, Fault::OfItsChunk));
    }
    Ok(Some(Err(broken)))
}
