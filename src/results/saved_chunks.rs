//! What an earlier run left in its folder: chunks, and the cells of them that have run.

use std::ops::Range;
use std::path::PathBuf;

use super::chunk::Fault;
use super::chunk_files::{ChunkFiles, SavedChunk};
use super::store_error::StoreError;
use crate::work::parallel;

/// What an earlier run left.
#[derive(Debug, Default)]
pub struct SavedChunks {
    /// Its whole chunks.
    pub chunks: Vec<SavedChunk>,
    /// Files that are not whole, and whose chunks are run again: each with what is wrong.
    pub broken: Vec<(PathBuf, Fault)>,
}

impl SavedChunks {
    /// The chunks that are in files; `progress` hears of the cells of each.
    ///
    /// # Errors
    /// Errors of the disk.
    pub fn in_files(
        files: &ChunkFiles,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<SavedChunks, StoreError> {
        let chunks = parallel::each(files.chunking.count(), 1, |chunk| {
            let found = files.find(chunk);
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
