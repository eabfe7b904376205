//! A grid's tiles on disk, read as its outcomes.

use std::borrow::Cow;
use std::io;
use std::ops::Range;

use super::tile::{self, Tile};
use crate::map::columns::Column;
use crate::map::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;

/// Tiles that hold every cell of a grid once.
#[derive(Debug)]
pub struct Shelf {
    /// By their first cells.
    tiles: Vec<Tile>,
}

impl Shelf {
    /// The shelf of tiles; none if they leave one of `count` cells out, or hold one twice.
    pub fn new(mut tiles: Vec<Tile>, count: usize) -> Option<Shelf> {
        tiles.sort_by_key(|tile| tile.cells.start);
        let mut end = 0;
        for tile in &tiles {
            if tile.cells.start != end {
                return None;
            }
            end = tile.cells.end;
        }
        (end == count).then_some(Shelf { tiles })
    }
}

impl Outcomes for Shelf {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        let mut outcomes = Vec::with_capacity(cells.len());
        let first = self.tiles.partition_point(|tile| tile.cells.end <= cells.start);
        for tile in self.tiles[first..].iter().take_while(|tile| tile.cells.start < cells.end) {
            let some = cells.start.max(tile.cells.start)..cells.end.min(tile.cells.end);
            outcomes.extend(tile::read(tile, some, columns)?);
        }
        Ok(Cow::Owned(outcomes))
    }
}

/// The runs of `wanted` cells that no tile holds.
pub fn missing(tiles: &[Tile], wanted: &Range<usize>) -> Vec<Range<usize>> {
    let mut held: Vec<&Range<usize>> = tiles.iter().map(|tile| &tile.cells).collect();
    held.sort_by_key(|cells| cells.start);
    let mut missing = Vec::new();
    let mut from = wanted.start;
    for cells in held {
        if cells.start > from {
            missing.push(from..cells.start.min(wanted.end));
        }
        from = from.max(cells.end);
    }
    if from < wanted.end {
        missing.push(from..wanted.end);
    }
    missing
}
