//! Who hears how far work is, and may end it.

use crate::results::block::Block;

/// Hears of cells that are done, and is asked whether to go on.
pub trait Progress: Sync {
    /// Hears of cells that are done.
    fn advance(&self, cells: usize);

    /// For the backends: true when outcomes of cells that are done, of a batch that goes on, are wanted: they are to be saved.
    #[doc(hidden)]
    fn wants_snapshot(&self) -> bool {
        false
    }

    /// For the backends: takes a batch's cells so far.
    #[doc(hidden)]
    fn snapshot(&self, block: Block) {
        let _ = block;
    }

    /// True when the work is to end. It is asked many times a second, by every thread.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody hears, and the work goes to its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn advance(&self, _: usize) {}
}
