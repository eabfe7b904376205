//! Collects outcomes as cells end: several threads put them into the columns in which they stay. These are saved from
//! time to time, so that an interrupted run can go on from there. If memory cannot hold the whole map, each chunk
//! leaves memory when it is complete.

use std::io;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::block::Block;
use super::chunking::Chunking;
use super::column_set::ColumnSet;
use super::outcomes::Outcomes;
use super::reader::{BlocksInMemory, ChunkReader, ShardFolder};
use super::saved_chunks::SavedChunks;
use super::store::Store;
use super::store_error::StoreError;
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;
use crate::work::threads::Threads;

/// Least time between two savings of a run, however often outcomes are to be saved.
const PAUSE: Duration = Duration::from_millis(50);

/// The number of complete chunks that may wait to leave memory.
const BACKLOG: usize = 3;

/// The cells of a chunk.
#[derive(Default)]
struct Chunk {
    /// Their columns, from the first outcome on; none of a chunk that has left memory.
    block: Option<Block>,
    /// The wanted cells that have not run yet.
    left: usize,
    /// True where outcomes are not on disk.
    unsaved: bool,
    /// True while outcomes are put into the columns, and where a thread panicked then: `left` is not right.
    changing: bool,
    /// The number of wanted cells that are on disk.
    on_disk: usize,
}

/// Where and when outcomes are saved.
pub struct Saver<'a> {
    /// The folder.
    pub store: &'a Store,
    /// The least time between two savings.
    pub patience: Duration,
    /// True where all outcomes stay in memory, too.
    pub holds: bool,
    /// The number of threads that save while cells run: one where the threads of the run are busy with cells.
    pub threads: NonZeroUsize,
    /// Asked before each file. Where it returns false, saving ends early, and the chunk on disk stays as it was.
    pub go_on: &'a (dyn Fn() -> bool + Sync),
}

/// What the thread that saves is to do.
#[derive(Default)]
struct ToSave {
    /// Complete chunks that are to leave memory.
    complete: Vec<usize>,
    /// True once a thread saves while cells run.
    saving: bool,
    /// True where nothing more is to be saved while cells run.
    ended: bool,
}

/// Collects the outcomes of a run.
pub struct OutcomeCollector<'a> {
    chunking: Chunking,
    precision: Precision,
    columns: ColumnSet,
    wanted: Range<usize>,
    saver: Option<Saver<'a>>,
    chunks: Vec<Mutex<Chunk>>,
    to_save: Mutex<ToSave>,
    changed: Condvar,
    failed: AtomicBool,
    /// Held by a thread that hands over cells with all threads, see [`OutcomeCollector::alone`].
    filling: Mutex<()>,
    began: Instant,
}

/// The value of a lock. What a thread has stored is complete, also where it panicked afterwards.
fn locked<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> OutcomeCollector<'a> {
    /// Collects some columns of a given number of cells in memory, in one piece.
    pub fn in_memory(
        cells: usize,
        precision: Precision,
        columns: ColumnSet,
    ) -> OutcomeCollector<'a> {
        let chunking = Chunking::with(vec![cells], usize::MAX);
        OutcomeCollector::of(chunking, (precision, columns), 0..cells, None)
    }

    fn of(
        chunking: Chunking,
        (precision, columns): (Precision, ColumnSet),
        wanted: Range<usize>,
        saver: Option<Saver<'a>>,
    ) -> OutcomeCollector<'a> {
        let chunks = (0..chunking.count()).map(|chunk| {
            let left = part_of(&wanted, &chunking.cells(chunk)).len();
            Mutex::new(Chunk { left, ..Chunk::default() })
        });
        OutcomeCollector {
            chunks: chunks.collect(),
            chunking,
            precision,
            columns,
            wanted,
            saver,
            to_save: Mutex::default(),
            changed: Condvar::new(),
            failed: AtomicBool::new(false),
            filling: Mutex::default(),
            began: Instant::now(),
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
        let (files, holds) = (saver.store.files(), saver.holds);
        let of = (files.precision, files.columns.held());
        let collector = OutcomeCollector::of(files.chunking.clone(), of, wanted, Some(saver));
        for saved in &found.chunks {
            let mut chunk = locked(&collector.chunks[saved.chunk]);
            let done = saved.done.iter().map(|cells| part_of(cells, &collector.wanted).len());
            chunk.on_disk = done.sum();
            chunk.left -= chunk.on_disk;
            // Others are as they are to be.
            if holds || chunk.left > 0 {
                chunk.block = Some(files.read(saved.chunk)?);
            }
        }
        Ok(collector)
    }

    /// True where all outcomes stay in memory.
    fn holds(&self) -> bool {
        self.saver.as_ref().is_none_or(|saver| saver.holds)
    }

    /// The number of wanted cells that are on disk.
    pub fn cells_on_disk(&self) -> usize {
        self.chunks.iter().map(|chunk| locked(chunk).on_disk).sum()
    }

    /// Takes outcomes of wanted cells by their numbers in the grid. They may come twice, where a device was lost.
    pub fn put(&self, cells: &[usize], outcomes: &[Outcome]) {
        let mut from = 0;
        while let Some(cell) = cells.get(from) {
            let number = self.chunking.chunk_of(*cell);
            let held = self.chunking.cells(number);
            let places: Vec<usize> = cells[from..]
                .iter()
                .take_while(|cell| held.contains(cell))
                .map(|cell| cell - held.start)
                .collect();
            let end = from + places.len();
            self.change(number, |block| {
                let new = block.pending_at(&places);
                block.place(&places, &outcomes[from..end]);
                new
            });
            from = end;
        }
    }

    /// Takes outcomes of consecutive wanted cells, by all threads: `of` adds those of some cells, by their places
    /// among them, to a list, or adds nothing where one of these has none.
    pub fn fill(&self, cells: Range<usize>, of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync) {
        for number in self.chunking.chunks(&cells) {
            let held = self.chunking.cells(number);
            let some = part_of(&cells, &held);
            let (first, skipped) = (some.start - held.start, some.start - cells.start);
            self.change(number, |block| {
                let places = first..first + some.len();
                let pending = block.pending_in(places.clone());
                block.fill(first, some.len(), |some, outcomes| {
                    of(some.start + skipped..some.end + skipped, outcomes);
                });
                pending - block.pending_in(places)
            });
        }
    }

    /// Waits until no other thread hands over cells with all threads. Two of them would wait for each other: one has a
    /// chunk and waits for the threads, which wait for the chunk.
    pub(crate) fn alone(&self) -> MutexGuard<'_, ()> {
        locked(&self.filling)
    }

    /// Changes the columns of a chunk; `change` returns the number of cells that had not run before. A complete chunk
    /// that is not held waits here while many others leave memory.
    fn change(&self, number: usize, change: impl FnOnce(&mut Block) -> usize) {
        let mut chunk = locked(&self.chunks[number]);
        if chunk.left == 0 {
            return;
        }
        let cells = self.chunking.cells(number);
        let pending = || Block::of(cells.len(), self.precision, self.columns);
        let Chunk { block, left, changing, .. } = &mut *chunk;
        let block = block.get_or_insert_with(pending);
        if std::mem::replace(changing, true) {
            let wanted = part_of(&self.wanted, &cells);
            *left = block.pending_in(wanted.start - cells.start..wanted.end - cells.start);
        }
        *left -= change(block).min(*left);
        *changing = false;
        chunk.unsaved = true;
        if chunk.left > 0 || self.holds() {
            return;
        }
        drop(chunk);
        let mut to_save = locked(&self.to_save);
        to_save.complete.push(number);
        self.changed.notify_all();
        let full = |to_save: &mut ToSave| {
            to_save.complete.len() > BACKLOG && to_save.saving && !to_save.ended
        };
        drop(self.changed.wait_while(to_save, full));
    }

    /// Saves from time to time, and chunks that are to leave memory, until [`OutcomeCollector::ends`].
    ///
    /// # Errors
    /// Those of the store; then the run is to end, see [`OutcomeCollector::failed`].
    pub fn save_meanwhile(&self) -> Result<(), StoreError> {
        let Some(saver) = &self.saver else { return Ok(()) };
        let _ended = self.ends_when_dropped();
        let threads = Threads::new(Some(saver.threads)).map_err(|error| {
            let reason = io::Error::other(error);
            self.failed.store(true, Ordering::Relaxed);
            StoreError::File { path: saver.store.path().to_path_buf(), reason }
        })?;
        locked(&self.to_save).saving = true;
        let patience = saver.patience.max(PAUSE);
        let mut saved = Instant::now();
        let save = || loop {
            let nothing = |to_save: &mut ToSave| to_save.complete.is_empty() && !to_save.ended;
            let wait = patience.saturating_sub(saved.elapsed());
            let to_save = locked(&self.to_save);
            let waited = self.changed.wait_timeout_while(to_save, wait, nothing);
            let (to_save, _) = waited.unwrap_or_else(PoisonError::into_inner);
            if to_save.ended {
                return Ok(());
            }
            let complete = to_save.complete.first().copied();
            drop(to_save);
            match complete {
                Some(chunk) => {
                    self.save(chunk)?;
                    locked(&self.to_save).complete.retain(|waits| *waits != chunk);
                    self.changed.notify_all();
                }
                None => {
                    self.save_all()?;
                    saved = Instant::now();
                }
            }
        };
        let result = threads.scope(save);
        self.failed.store(result.is_err(), Ordering::Relaxed);
        result
    }

    /// No cell runs any more: what saves meanwhile ends.
    pub fn ends(&self) {
        locked(&self.to_save).ended = true;
        self.changed.notify_all();
    }

    /// The same where the result is dropped, whatever ends the thread that has it.
    pub fn ends_when_dropped<'c>(&'c self) -> impl Drop + use<'c, 'a> {
        struct Ends<'c, 'a>(&'c OutcomeCollector<'a>);
        impl Drop for Ends<'_, '_> {
            fn drop(&mut self) {
                if std::thread::panicking() {
                    self.0.failed.store(true, Ordering::Relaxed);
                }
                self.0.ends();
            }
        }
        Ends(self)
    }

    /// True where saving failed.
    pub fn failed(&self) -> bool {
        self.failed.load(Ordering::Relaxed)
    }

    /// Saves a chunk, which leaves memory if it is complete and not held; false where saving ended early.
    fn save(&self, number: usize) -> Result<bool, StoreError> {
        let Some(saver) = &self.saver else { return Ok(true) };
        let mut chunk = locked(&self.chunks[number]);
        if !chunk.unsaved {
            return Ok(true);
        }
        let left = chunk.left;
        let leaves = left == 0 && !self.holds();
        // It is written from a copy, so that no thread waits for the disk.
        let block = if leaves { chunk.block.take() } else { chunk.block.clone() };
        chunk.unsaved = false;
        drop(chunk);
        let Some(block) = block else { return Ok(true) };
        let saved = saver.store.save_while(number, &block, saver.go_on);
        let mut chunk = locked(&self.chunks[number]);
        if let Ok(true) = saved {
            chunk.on_disk = part_of(&self.wanted, &self.chunking.cells(number)).len() - left;
        } else {
            chunk.unsaved = true;
            chunk.block.get_or_insert(block);
        }
        saved
    }

    /// Saves all chunks; false where saving ended early.
    fn save_all(&self) -> Result<bool, StoreError> {
        for number in 0..self.chunks.len() {
            if !self.save(number)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Saves what is only in memory, because the run is about to end; a short run is not worth saving. False where saving ended early.
    ///
    /// # Errors
    /// Those of the store.
    pub fn rescue(&self) -> Result<bool, StoreError> {
        let long = |saver: &Saver| !saver.holds || self.began.elapsed() >= saver.patience;
        if self.saver.as_ref().is_some_and(long) { self.save_all() } else { Ok(true) }
    }

    /// Ends the collection of a shard: all of its cells are on disk.
    ///
    /// # Errors
    /// Those of the store.
    pub fn finish_shard(self) -> Result<(), StoreError> {
        self.save_all()?;
        let whole = self.cells_on_disk() == self.wanted.len();
        if whole { Ok(()) } else { Err(StoreError::Incomplete) }
    }

    /// All outcomes of a grid of which every cell was wanted; where memory does not hold them, a reader of those on disk. Outcomes
    /// that are not saved yet are saved first unless the run was short, because writing the map takes time, too.
    ///
    /// # Errors
    /// Those of the store.
    pub fn finish(self) -> Result<Box<dyn Outcomes>, StoreError> {
        let saved = self.rescue()?;
        let holds = self.holds();
        if !holds && !saved || self.chunks.iter().any(|chunk| locked(chunk).left > 0) {
            return Err(StoreError::Incomplete);
        }
        if holds {
            let chunking = self.chunking.clone();
            return Ok(Box::new(BlocksInMemory::new(chunking, self.into_blocks())));
        }
        let OutcomeCollector { wanted, saver, .. } = self;
        let files = saver.ok_or(StoreError::Incomplete)?.store.files().clone();
        let count = wanted.len();
        let reader = ChunkReader::new(vec![ShardFolder { cells: wanted, files }], count);
        Ok(Box::new(reader.ok_or(StoreError::Incomplete)?))
    }

    /// The columns of all cells of what is collected in one piece; cells that have not run are pending.
    pub fn into_block(self) -> Block {
        Block::joined(self.into_blocks())
    }

    /// The columns of all chunks.
    fn into_blocks(self) -> Vec<Block> {
        let OutcomeCollector { chunks, chunking, precision, columns, .. } = self;
        let block = |(number, chunk): (usize, Mutex<Chunk>)| {
            let chunk = chunk.into_inner().unwrap_or_else(PoisonError::into_inner);
            let pending = || Block::of(chunking.cells(number).len(), precision, columns);
            chunk.block.unwrap_or_else(pending)
        };
        chunks.into_iter().enumerate().map(block).collect()
    }
}

/// The cells that are in both ranges.
fn part_of(cells: &Range<usize>, others: &Range<usize>) -> Range<usize> {
    let first = cells.start.max(others.start);
    first..cells.end.min(others.end).max(first)
}
