//! Outcomes of a grid, read from its blocks in memory or from chunks on disk.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use super::block::Block;
use super::chunk_files::ChunkFiles;
use super::chunking::Chunking;
use super::columns::Column;
use super::outcomes::Outcomes;
use super::values::{ColumnValues, ValueType};
use crate::model::precision::Precision;
use crate::stepping::outcome::Outcome;

/// All columns of a grid in memory, chunk by chunk.
#[derive(Debug)]
pub struct BlocksInMemory {
    chunking: Chunking,
    blocks: Vec<Block>,
}

impl BlocksInMemory {
    /// The blocks of all chunks.
    pub fn new(chunking: Chunking, blocks: Vec<Block>) -> BlocksInMemory {
        BlocksInMemory { chunking, blocks }
    }
}

/// Goes through the chunks that hold some cells: `read` is handed a chunk, the place in it of the first of
/// the cells, and the outcomes to fill.
fn each_chunk(
    chunking: &Chunking,
    cells: &Range<usize>,
    outcomes: &mut [Outcome],
    mut read: impl FnMut(usize, usize, &mut [Outcome]) -> io::Result<()>,
) -> io::Result<()> {
    for chunk in chunking.chunks(cells) {
        let held = chunking.cells(chunk);
        let (first, end) = (cells.start.max(held.start), cells.end.min(held.end));
        let some = &mut outcomes[first - cells.start..end - cells.start];
        read(chunk, first - held.start, some)?;
    }
    Ok(())
}

impl Outcomes for BlocksInMemory {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        each_chunk(&self.chunking, &cells, &mut outcomes, |chunk, first, some| {
            self.blocks[chunk].read(first, columns, some);
            Ok(())
        })?;
        Ok(Cow::Owned(outcomes))
    }

    fn column(
        &self,
        cells: Range<usize>,
        column: Column,
        precision: Precision,
    ) -> io::Result<ColumnValues> {
        let of = ValueType::of(column.entry().kind, precision);
        let mut values = ColumnValues::all(column.entry().kind.filler(), of, cells.len());
        for chunk in self.chunking.chunks(&cells) {
            let held = self.chunking.cells(chunk);
            let (first, end) = (cells.start.max(held.start), cells.end.min(held.end));
            let from = self.blocks[chunk].values(column);
            if !from.is_empty() {
                let slots = values.slots(first - cells.start..end - cells.start);
                slots.copy(from, first - held.start..end - held.start);
            }
        }
        Ok(values)
    }

    fn into_block(self: Box<Self>, _: usize, _: Precision) -> io::Result<Block> {
        Ok(Block::joined(self.blocks))
    }
}

/// Cells that a folder holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShardFolder {
    /// Their numbers.
    pub cells: Range<usize>,
    /// The files of their chunks.
    pub files: ChunkFiles,
}

/// A column of a chunk in a folder, all three by their numbers.
type Place = (usize, usize, Column);

/// Outcomes that lie on disk, in one folder or in several that hold a shard each.
#[derive(Debug)]
pub struct ChunkReader {
    /// By their first cells.
    held: Vec<ShardFolder>,
    /// The last values read of each column: who goes through a map asks for a chunk's many times.
    last: Mutex<BTreeMap<usize, (Place, Arc<ColumnValues>)>>,
}

impl ChunkReader {
    /// The reader of folders of one grid; none if they leave one of `count` cells out, or hold one twice.
    pub fn new(mut held: Vec<ShardFolder>, count: usize) -> Option<ChunkReader> {
        held.sort_by_key(|held| held.cells.start);
        let mut end = 0;
        for held in &held {
            if held.cells.start != end {
                return None;
            }
            end = held.cells.end;
        }
        (end == count).then(|| ChunkReader { held, last: Mutex::default() })
    }

    /// The values of a column of a chunk in a folder.
    fn values(&self, place: Place) -> io::Result<Arc<ColumnValues>> {
        let (folder, chunk, column) = place;
        let known = |last: &BTreeMap<usize, (Place, Arc<ColumnValues>)>| {
            last.get(&(column as usize))
                .filter(|(of, _)| *of == place)
                .map(|(_, values)| values.clone())
        };
        // What a thread that broke off leaves is whole: values are made before they are kept.
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(values) = known(&last()) {
            return Ok(values);
        }
        let values = self.held[folder].files.column(chunk, column)?;
        let values = Arc::new(values);
        last().insert(column as usize, (place, values.clone()));
        Ok(values)
    }
}

impl Outcomes for ChunkReader {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        let from = self.held.partition_point(|held| held.cells.end <= cells.start);
        let holding = self.held.iter().enumerate().skip(from);
        for (folder, held) in holding.take_while(|(_, held)| held.cells.start < cells.end) {
            let some = cells.start.max(held.cells.start)..cells.end.min(held.cells.end);
            let place = some.start - cells.start..some.end - cells.start;
            each_chunk(
                &held.files.chunking,
                &some,
                &mut outcomes[place],
                |chunk, first, outcomes| {
                    for column in columns {
                        let entry = column.entry();
                        if held.files.columns.held().has(*column) {
                            let values = self.values((folder, chunk, *column))?;
                            (entry.give)(&values, first, outcomes);
                        } else {
                            let of = ValueType::of(entry.kind, held.files.precision);
                            let absent = ColumnValues::all(entry.kind.filler(), of, outcomes.len());
                            (entry.give)(&absent, 0, outcomes);
                        }
                    }
                    Ok(())
                },
            )?;
        }
        Ok(Cow::Owned(outcomes))
    }

    fn moved(&mut self, from: &Path, to: &Path) {
        for held in self.held.iter_mut().filter(|held| held.files.folder == from) {
            held.files.folder = to.to_path_buf();
        }
    }
}

/// The runs of `wanted` cells that are not among those done.
pub fn missing(done: &[Range<usize>], wanted: &Range<usize>) -> Vec<Range<usize>> {
    let mut done: Vec<&Range<usize>> = done.iter().collect();
    done.sort_by_key(|cells| cells.start);
    let mut missing = Vec::new();
    let mut from = wanted.start;
    for cells in done {
        if cells.start > from {
            missing.push(from..cells.start.min(wanted.end));
        }
        from = from.max(cells.end);
        if from >= wanted.end {
            return missing;
        }
    }
    if from < wanted.end {
        missing.push(from..wanted.end);
    }
    missing
}
