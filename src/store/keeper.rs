//! Where outcomes go as they are done: into memory and, where that takes long, to disk; or to disk at
//! once, where memory does not hold them all.

use std::io;
use std::ops::Range;
use std::time::{Duration, Instant};

use super::shelf::Shelf;
use super::tile::{self, Tile};
use super::{Store, StoreError};
use crate::map::columns::Column;
use crate::map::outcomes::Outcomes;
use crate::stepping::outcome::Outcome;

/// Collects the outcomes of a run.
pub struct Keeper<'a> {
    store: &'a Store,
    place: Place,
    /// Of what is only in memory: runs of cells.
    waiting: Vec<Range<usize>>,
    patience: Duration,
    began: Instant,
    kept: Instant,
}

enum Place {
    Memory(Vec<Outcome>),
    Disk(Vec<Tile>),
}

impl<'a> Keeper<'a> {
    /// Holds all `count` outcomes of a grid in memory, those of the tiles that were found to begin with,
    /// and keeps what is new when `patience` has passed since the last time.
    ///
    /// # Errors
    /// Those of reading the tiles.
    pub fn in_memory(
        store: &'a Store,
        found: &[Tile],
        count: usize,
        patience: Duration,
    ) -> io::Result<Keeper<'a>> {
        let mut outcomes = vec![Outcome::PENDING; count];
        for found in found {
            // The identity has the grid: no tile reaches beyond it.
            let cells = found.cells.clone();
            outcomes[cells.clone()].copy_from_slice(&tile::read(found, cells, &Column::ALL)?);
        }
        Ok(Keeper::new(store, Place::Memory(outcomes), patience))
    }

    /// Keeps all on disk, tile by tile as they come.
    pub fn on_disk(store: &'a Store, found: Vec<Tile>) -> Keeper<'a> {
        Keeper::new(store, Place::Disk(found), Duration::ZERO)
    }

    fn new(store: &'a Store, place: Place, patience: Duration) -> Keeper<'a> {
        let now = Instant::now();
        Keeper { store, place, waiting: Vec::new(), patience, began: now, kept: now }
    }

    /// Takes the outcomes of cells from `first` on.
    ///
    /// # Errors
    /// Those of the store.
    pub fn take(&mut self, first: usize, outcomes: &[Outcome]) -> Result<(), StoreError> {
        let cells = first..first + outcomes.len();
        match &mut self.place {
            Place::Disk(tiles) => {
                tiles.push(self.store.keep(first, outcomes)?);
                return Ok(());
            }
            Place::Memory(all) => all[cells.clone()].copy_from_slice(outcomes),
        }
        match self.waiting.iter_mut().find(|waiting| waiting.end == cells.start) {
            Some(waiting) => waiting.end = cells.end,
            None => self.waiting.push(cells),
        }
        if self.kept.elapsed() >= self.patience {
            self.keep_waiting()?;
        }
        Ok(())
    }

    /// Keeps what is only in memory, if the run has been long at all: it is about to end.
    ///
    /// # Errors
    /// Those of the store.
    pub fn rescue(&mut self) -> Result<(), StoreError> {
        if self.began.elapsed() >= self.patience { self.keep_waiting() } else { Ok(()) }
    }

    fn keep_waiting(&mut self) -> Result<(), StoreError> {
        if let Place::Memory(all) = &self.place {
            for cells in self.waiting.drain(..) {
                self.store.keep(cells.start, &all[cells])?;
            }
        }
        self.kept = Instant::now();
        Ok(())
    }

    /// All outcomes of a grid of `count` cells. What is left over goes to disk if the run has been
    /// long at all: to write the map takes its time, too.
    ///
    /// # Errors
    /// Those of the store.
    pub fn finish(mut self, count: usize) -> Result<Box<dyn Outcomes>, StoreError> {
        self.rescue()?;
        match self.place {
            Place::Memory(outcomes) => Ok(Box::new(outcomes)),
            Place::Disk(tiles) => match Shelf::new(tiles, count) {
                Some(shelf) => Ok(Box::new(shelf)),
                None => Err(StoreError::Incomplete),
            },
        }
    }
}
