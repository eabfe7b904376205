//! Collects outcomes as cells end: in blocks in memory, which are saved from time to time, so that an interrupted run can
//! go on from there. If memory cannot hold the whole map, each block leaves memory when it is complete.

use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::time::{Duration, Instant};

use super::block::Block;
use super::chunking::Chunking;
use super::outcomes::Outcomes;
use super::reader::{BlocksInMemory, ChunkReader, ShardFolder};
use super::saved_chunks::SavedChunks;
use super::store::Store;
use super::store_error::StoreError;
use crate::model::precision::Precision;

/// A chunk that is not complete, or that is held for the map.
struct OpenChunk {
    block: Block,
    /// The wanted cells that have not run yet.
    left: usize,
    /// True where the chunk has outcomes that are not on disk.
    unsaved: bool,
}

/// Where and when outcomes are saved.
pub struct Saver<'a> {
    /// The folder.
    pub store: &'a Store,
    /// The least time between two savings.
    pub patience: Duration,
    /// True where all outcomes stay in memory, too.
    pub holds: bool,
    /// Asked before each file. Where it returns false, saving ends early, and the chunk on disk stays as it was.
    pub go_on: &'a (dyn Fn() -> bool + Sync),
}

/// Collects the outcomes of a run.
pub struct OutcomeCollector<'a> {
    chunking: Chunking,
    precision: Precision,
    wanted: Range<usize>,
    saver: Option<Saver<'a>>,
    open: BTreeMap<usize, OpenChunk>,
    /// The number of cells of each chunk that are on disk.
    on_disk: BTreeMap<usize, usize>,
    began: Instant,
    saved: Instant,
}

impl<'a> OutcomeCollector<'a> {
    /// Collects the `wanted` cells of a grid in memory; `chunking` says how the grid is cut into chunks.
    pub fn in_memory(
        chunking: Chunking,
        precision: Precision,
        wanted: Range<usize>,
    ) -> OutcomeCollector<'a> {
        let (now, open, on_disk) = (Instant::now(), BTreeMap::new(), BTreeMap::new());
        let saver = None;
        OutcomeCollector {
            chunking,
            precision,
            wanted,
            saver,
            open,
            on_disk,
            began: now,
            saved: now,
        }
    }

    /// Collects the `wanted` cells of a store's grid, of which some were found.
    ///
    /// # Errors
    /// Those of reading what was found.
    pub fn saving(
        saver: Saver<'a>,
        found: &SavedChunks,
        wanted: Range<usize>,
    ) -> io::Result<OutcomeCollector<'a>> {
        let (store, holds) = (saver.store, saver.holds);
        let (chunking, precision) = (store.files().chunking.clone(), store.files().precision);
        let mut collector = OutcomeCollector::in_memory(chunking, precision, wanted);
        collector.saver = Some(saver);
        for saved in &found.chunks {
            let left = collector.left_of(saved.chunk, &saved.done);
            let done = collector.wanted_of(saved.chunk).len() - left;
            collector.on_disk.insert(saved.chunk, done);
            // Others are as they are to be.
            if holds || left > 0 {
                let open =
                    OpenChunk { block: store.files().read(saved.chunk)?, left, unsaved: false };
                collector.open.insert(saved.chunk, open);
            }
        }
        Ok(collector)
    }

    /// The wanted cells of a chunk that are not done yet.
    fn left_of(&self, chunk: usize, done: &[Range<usize>]) -> usize {
        let wanted = self.wanted_of(chunk);
        let done = done
            .iter()
            .map(|cells| cells.end.min(wanted.end).saturating_sub(cells.start.max(wanted.start)));
        wanted.len() - done.sum::<usize>()
    }

    /// The wanted cells of a chunk.
    fn wanted_of(&self, chunk: usize) -> Range<usize> {
        let cells = self.chunking.cells(chunk);
        let first = cells.start.max(self.wanted.start);
        first..cells.end.min(self.wanted.end).max(first)
    }

    /// True where all outcomes stay in memory.
    fn holds(&self) -> bool {
        self.saver.as_ref().is_none_or(|saver| saver.holds)
    }

    /// The number of wanted cells that are on disk.
    pub fn cells_on_disk(&self) -> usize {
        self.on_disk.values().sum()
    }

    /// Takes those cells of a block that have run; the first cell of the block is the cell `first` of the grid.
    ///
    /// # Errors
    /// Those of the store.
    pub fn take(&mut self, first: usize, block: Block) -> Result<(), StoreError> {
        let whole = block.pending_in(0..block.len()) == 0;
        if let (true, Some(chunk)) = (whole, self.new_chunk_of(first, &block)) {
            // In one piece, which is kept as it is.
            let left = self.wanted_of(chunk).len() - block.len();
            self.open.insert(chunk, OpenChunk { block, left, unsaved: true });
            self.ended(chunk)?;
        } else {
            for cells in block.done() {
                self.take_run(first, &block, cells)?;
            }
        }
        if self.saver.as_ref().is_some_and(|saver| self.saved.elapsed() >= saver.patience) {
            self.save_all()?;
        }
        Ok(())
    }

    /// The chunk that a block from a cell on fills completely; none where the chunk already has cells.
    fn new_chunk_of(&self, first: usize, block: &Block) -> Option<usize> {
        let cells = first..first + block.len();
        let chunk = self.chunking.chunks(&cells).next()?;
        let whole = self.chunking.cells(chunk) == cells && self.wanted_of(chunk) == cells;
        let new = !self.open.contains_key(&chunk) && !self.on_disk.contains_key(&chunk);
        (whole && new && block.precision() == self.precision).then_some(chunk)
    }

    /// Takes cells of a block, all of which have run; the first cell of the block is the cell `first` of the grid.
    fn take_run(
        &mut self,
        first: usize,
        run: &Block,
        cells: Range<usize>,
    ) -> Result<(), StoreError> {
        let cells = first + cells.start..first + cells.end;
        for chunk in self.chunking.chunks(&cells) {
            let held = self.chunking.cells(chunk);
            let some = cells.start.max(held.start)..cells.end.min(held.end);
            if !self.open.contains_key(&chunk) {
                if self.on_disk.get(&chunk) == Some(&self.wanted_of(chunk).len()) {
                    continue;
                }
                let block = Block::pending(held.len(), self.precision);
                let left = self.wanted_of(chunk).len();
                self.open.insert(chunk, OpenChunk { block, left, unsaved: false });
            }
            let Some(open) = self.open.get_mut(&chunk) else { continue };
            let places = some.start - held.start..some.end - held.start;
            // Cells may come twice: alone, and with their batch.
            open.left -= open.block.pending_in(places.clone()).min(open.left);
            open.block.take(places.start, run, some.start - first..some.end - first);
            open.unsaved = true;
            self.ended(chunk)?;
        }
        Ok(())
    }

    /// Saves a chunk that is complete and is not held in memory.
    fn ended(&mut self, chunk: usize) -> Result<(), StoreError> {
        let whole = self.open.get(&chunk).is_some_and(|open| open.left == 0);
        if whole && !self.holds() && self.save(chunk)? {
            self.open.remove(&chunk);
        }
        Ok(())
    }

    /// Saves what is only in memory, because the run is about to end; a short run is not worth saving. False where saving ended early.
    ///
    /// # Errors
    /// Those of the store.
    pub fn rescue(&mut self) -> Result<bool, StoreError> {
        let long = |saver: &Saver| !saver.holds || self.began.elapsed() >= saver.patience;
        if self.saver.as_ref().is_some_and(long) { self.save_all() } else { Ok(true) }
    }

    /// Saves a chunk; false where saving ended early.
    fn save(&mut self, chunk: usize) -> Result<bool, StoreError> {
        let wanted = self.wanted_of(chunk).len();
        if let (Some(saver), Some(open)) = (&self.saver, self.open.get_mut(&chunk))
            && open.unsaved
        {
            if !saver.store.save_while(chunk, &open.block, saver.go_on)? {
                return Ok(false);
            }
            open.unsaved = false;
            self.on_disk.insert(chunk, wanted - open.left);
        }
        Ok(true)
    }

    /// Saves all chunks; false where saving ended early.
    fn save_all(&mut self) -> Result<bool, StoreError> {
        let chunks: Vec<usize> = self.open.keys().copied().collect();
        for chunk in chunks {
            if !self.save(chunk)? {
                return Ok(false);
            }
        }
        self.saved = Instant::now();
        Ok(true)
    }

    /// Ends the collection of a shard: all of its cells are on disk.
    ///
    /// # Errors
    /// Those of the store.
    pub fn finish_shard(mut self) -> Result<(), StoreError> {
        self.save_all()?;
        let whole = self.cells_on_disk() == self.wanted.len();
        if whole { Ok(()) } else { Err(StoreError::Incomplete) }
    }

    /// All outcomes of a grid of which every cell was wanted; where memory does not hold them, a reader of those on disk. Outcomes
    /// that are not saved yet are saved first unless the run was short, because writing the map takes time, too.
    ///
    /// # Errors
    /// Those of the store.
    pub fn finish(mut self) -> Result<Box<dyn Outcomes>, StoreError> {
        let saved = self.rescue()?;
        let holds = self.holds();
        if !holds && !saved {
            return Err(StoreError::Incomplete);
        }
        let OutcomeCollector { chunking, wanted, saver, open, .. } = self;
        if holds {
            if open.len() != chunking.count() || open.values().any(|open| open.left > 0) {
                return Err(StoreError::Incomplete);
            }
            let blocks = open.into_values().map(|open| open.block).collect();
            return Ok(Box::new(BlocksInMemory::new(chunking, blocks)));
        }
        let files = saver.ok_or(StoreError::Incomplete)?.store.files().clone();
        let count = wanted.len();
        let reader = ChunkReader::new(vec![ShardFolder { cells: wanted, files }], count);
        Ok(Box::new(reader.ok_or(StoreError::Incomplete)?))
    }
}
