//! What refining did, level by level, and how much it may have missed.

use serde::{Deserialize, Serialize};

/// A round of probes: cells drawn at random among those that were not run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ProbeRound {
    /// Cells that were left alone: not run, and taken to have the outcome around them.
    pub left_alone: usize,
    /// Cells drawn and run, one a stratum.
    pub probes: usize,
    /// Those with another outcome than was taken. What they lie in was refined then.
    pub missed: usize,
    /// The largest share of the cells left alone that has another outcome, before corrections: at 95 % over all
    /// rounds of a level, however many are made.
    pub share_missed_at_most: f64,
    /// Where numbers are to be smooth: probes of the outcome that was taken whose numbers are off by more than the
    /// tolerance. What they lie in was refined then.
    pub rough: usize,
    /// The largest share of the cells left alone that are such, at 95 %; none where numbers need not be smooth.
    pub share_rough_at_most: Option<f64>,
}

/// A level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Its number, from 1 on.
    pub level: u32,
    /// Columns and rows of a grid as fine as that.
    pub shape: (usize, usize),
    /// Boxes that were split.
    pub boxes: usize,
    /// Those of them because of an island: a cell in them that another box had run has another outcome.
    pub islands: usize,
    /// Cells that were run, without probes.
    pub cells: usize,
    /// Seconds that it took.
    pub seconds: f64,
    /// Rounds of probes.
    pub probes: Vec<ProbeRound>,
}

/// What refining did.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RefineReport {
    /// Columns and rows of the finest grid.
    pub shape: (usize, usize),
    /// Cells that were run, those of the map and the probes included.
    pub cells: usize,
    /// Their share of the finest grid's.
    pub share: f64,
    /// Leaves: boxes of one outcome each, or between neighbouring cells of the finest grid.
    pub leaves: usize,
    /// Cells that were not run in leaves beside a smaller one: a boundary is near, and they are less sure than others.
    pub beside: usize,
    /// The same in leaves whose corners overturn after different numbers of impacts, 10 or more, which are not told
    /// apart.
    pub impacts_differ: usize,
    /// The same in leaves of either mark.
    pub marked: usize,
    /// The share of their range on the map by which numbers between cells that were run may be off; none where nothing
    /// is said of them.
    pub smooth: Option<f64>,
    /// Seconds of refining, without the map's sweep.
    pub seconds: f64,
    /// The levels.
    pub levels: Vec<Level>,
}

impl RefineReport {
    /// The last round of probes.
    pub fn last_round(&self) -> Option<&ProbeRound> {
        self.levels.last().and_then(|level| level.probes.last())
    }
}
