//! Outcomes of a grid, read from its blocks in memory or from tiles on disk.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::block::{self, Block};
use super::cell_value::Stored;
use super::columns::{Column, ColumnType, TABLE, with_column};
use super::element::ColumnNumber;
use super::outcomes::Outcomes;
use super::tile;
use super::tiling::Tiling;
use super::zarr::chunk_path;
use crate::model::precision::Precision;
use crate::scene::bounded;
use crate::stepping::outcome::Outcome;

/// All columns of a grid in memory, tile by tile.
#[derive(Debug)]
pub struct BlocksInMemory {
    tiling: Tiling,
    blocks: Vec<Block>,
}

impl BlocksInMemory {
    /// The blocks of all tiles of a tiling.
    pub fn new(tiling: Tiling, blocks: Vec<Block>) -> BlocksInMemory {
        BlocksInMemory { tiling, blocks }
    }
}

/// Goes through the tiles that hold some cells: `read` is handed a tile, the place in it of the first of
/// the cells, and the outcomes to fill.
fn each_tile(
    tiling: &Tiling,
    cells: &Range<usize>,
    outcomes: &mut [Outcome],
    mut read: impl FnMut(usize, usize, &mut [Outcome]) -> io::Result<()>,
) -> io::Result<()> {
    for tile in tiling.tiles(cells) {
        let held = tiling.cells(tile);
        let (first, end) = (cells.start.max(held.start), cells.end.min(held.end));
        let some = &mut outcomes[first - cells.start..end - cells.start];
        read(tile, first - held.start, some)?;
    }
    Ok(())
}

impl Outcomes for BlocksInMemory {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        each_tile(&self.tiling, &cells, &mut outcomes, |tile, first, some| {
            self.blocks[tile].read(first, columns, some);
            Ok(())
        })?;
        Ok(Cow::Owned(outcomes))
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
    /// The Zarr group of their tiles.
    pub folder: PathBuf,
    /// The number type of its columns.
    pub precision: Precision,
}

/// A column of a tile in a folder, all three by their numbers.
type Place = (usize, usize, usize);

/// Fills a column of outcomes of cells from a place on.
type FillColumn = dyn Fn(usize, &mut [Outcome]) + Send + Sync;

/// That of the values of a column.
fn filling<C: ColumnType, F: ColumnNumber>(values: Vec<Stored<C::Value, F>>) -> Arc<FillColumn> {
    Arc::new(move |first, outcomes| block::read::<C, F>(&values[first..], outcomes))
}

/// Outcomes that lie on disk, in one folder or in several that hold a shard each.
pub struct TileReader {
    tiling: Tiling,
    /// By their first cells.
    held: Vec<ShardFolder>,
    /// The last values read of each column: who goes through a map asks for a tile's many times.
    last: Mutex<BTreeMap<usize, (Place, Arc<FillColumn>)>>,
}

impl fmt::Debug for TileReader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TileReader").field("held", &self.held).finish_non_exhaustive()
    }
}

impl TileReader {
    /// The reader of folders; none if they leave one of `count` cells out, or hold one twice.
    pub fn new(tiling: Tiling, mut held: Vec<ShardFolder>, count: usize) -> Option<TileReader> {
        held.sort_by_key(|held| held.cells.start);
        let mut end = 0;
        for held in &held {
            if held.cells.start != end {
                return None;
            }
            end = held.cells.end;
        }
        let last = Mutex::default();
        (end == count).then_some(TileReader { tiling, held, last })
    }

    /// The values of a column of a tile in a folder.
    fn values(&self, place: Place) -> io::Result<Arc<FillColumn>> {
        let (folder, tile, column) = place;
        let known = |last: &BTreeMap<usize, (Place, Arc<FillColumn>)>| {
            last.get(&column).filter(|(of, _)| *of == place).map(|(_, values)| values.clone())
        };
        // What a thread that broke off leaves is whole: values are made before they are kept.
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(values) = known(&last()) {
            return Ok(values);
        }
        let (ShardFolder { folder: path, precision, .. }, entry) =
            (&self.held[folder], &TABLE[column]);
        let mut chunks = |array: &str, count| {
            let path = path.join(chunk_path(array, &self.tiling, tile));
            let named = |e: io::Error| io::Error::new(e.kind(), format!("{}: {e}", path.display()));
            Ok(tile::unpack(&bounded::read(&path, tile::LARGEST).map_err(named)?, count))
        };
        let sizes = (self.tiling.cells(tile).len(), self.tiling.tile_cells());
        let values = with_column!(entry.column, C => match precision {
            Precision::F32 => tile::decode::<C, f32, io::Error>(sizes, &mut chunks)?.map(filling::<C, f32>),
            Precision::F64 => tile::decode::<C, f64, io::Error>(sizes, &mut chunks)?.map(filling::<C, f64>),
        });
        let values = values.ok_or_else(|| {
            let array = path.join(chunk_path(entry.name, &self.tiling, tile));
            let problem = format!("{}: damaged since it was found", array.display());
            io::Error::new(io::ErrorKind::InvalidData, problem)
        })?;
        last().insert(column, (place, values.clone()));
        Ok(values)
    }
}

impl Outcomes for TileReader {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        let from = self.held.partition_point(|held| held.cells.end <= cells.start);
        let holding = self.held.iter().enumerate().skip(from);
        for (folder, held) in holding.take_while(|(_, held)| held.cells.start < cells.end) {
            let some = cells.start.max(held.cells.start)..cells.end.min(held.cells.end);
            let place = some.start - cells.start..some.end - cells.start;
            each_tile(&self.tiling, &some, &mut outcomes[place], |tile, first, outcomes| {
                for column in columns {
                    let values = self.values((folder, tile, *column as usize))?;
                    values(first, outcomes);
                }
                Ok(())
            })?;
        }
        Ok(Cow::Owned(outcomes))
    }

    fn moved(&mut self, from: &Path, to: &Path) {
        for held in self.held.iter_mut().filter(|held| held.folder == from) {
            held.folder = to.to_path_buf();
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
