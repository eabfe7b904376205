//! Snapshots of a batch that is still running, on their way from a backend to who saves them:
//! in the grid's order, and as they will be at the end.

use crate::cells::plan::Part;
use crate::results::block::Block;
use crate::stepping::outcome::{Class, Status};
use crate::work::progress::Progress;

/// Makes the cells of a run what they are for who hears.
type Change<'a> = dyn Fn(Block) -> Block + Sync + 'a;

/// Passes on what a run tells, its snapshots changed; or without any, of a run whose outcomes nobody is to have.
pub struct PassedOn<'a> {
    /// Who hears.
    pub progress: &'a dyn Progress,
    /// What becomes of snapshots; none are taken without it.
    pub change: Option<&'a Change<'a>>,
}

impl Progress for PassedOn<'_> {
    fn advance(&self, cells: usize) {
        self.progress.advance(cells);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled()
    }

    fn wants_snapshot(&self) -> bool {
        self.change.is_some() && self.progress.wants_snapshot()
    }

    fn snapshot(&self, block: Block) {
        if let Some(change) = self.change {
            self.progress.snapshot(change(block));
        }
    }
}

impl Part {
    /// Its cells as they are told: one whose vertical direction is locked says so.
    pub(crate) fn mark_locked(&self, mut block: Block) -> Block {
        if self.vertical_locked {
            block.recode(|_, class, status| match status {
                Status::Ok | Status::Proved => (class, Status::VerticalLocked),
                other => (class, other),
            });
        }
        block
    }

    /// Its cells among those of a list of so many, of which the others have not run.
    pub(crate) fn scatter_into(&self, count: usize, block: Block) -> Block {
        if block.len() == count {
            // A part alone holds every cell, in order.
            return block;
        }
        let mut all = Block::pending(count, block.precision());
        all.scatter(&self.places, &block);
        all
    }
}

/// Calls cells unresolved that another run classifies otherwise; those that have not run stay so.
pub fn resolve(block: &mut Block, other: &Block) {
    block.recode(|cell, class, status| {
        if class == other.class(cell) || class == Class::Unresolved {
            (class, status)
        } else {
            (Class::Unresolved, Status::Undecided)
        }
    });
}
