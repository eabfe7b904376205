//! What a backend tells of a batch while it runs: to the observer, and to who saves finished cells.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::batches::HandOver;
use crate::results::block::Block;
use crate::work::observer::Observer;
use crate::work::progress::Progress;

/// Least time between two snapshots of a batch, and least time that a batch is to take, however often finished
/// cells are to be saved.
pub const SHORTEST: Duration = Duration::from_millis(500);

/// Hears of a batch: passes on to the observer what it is to know, and outcomes to who saves them.
pub(crate) struct BatchWatch<'a> {
    /// Who hears of cells, and may end the sweep.
    pub observer: &'a dyn Observer,
    /// The batch's first cell.
    pub first: usize,
    /// Who saves outcomes.
    pub hand_over: &'a HandOver<'a>,
    /// Time between two snapshots; none where nothing is saved.
    pub every: Option<Duration>,
    /// When the last snapshot was taken.
    pub last: Mutex<Instant>,
}

impl Progress for BatchWatch<'_> {
    fn advance(&self, cells: usize) {
        self.observer.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }

    fn wants_snapshot(&self) -> bool {
        let Some(every) = self.every else { return false };
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let wants = last.elapsed() >= every.max(SHORTEST);
        if wants {
            *last = Instant::now();
        }
        wants
    }

    fn snapshot(&self, block: Block) {
        if self.every.is_some() {
            (self.hand_over)(self.first, block);
        }
    }
}
