//! The capacity of a record as a set of levels: a block that overturns at one level need not at a higher one.

use super::runs::{RecordRuns, Run, weighed};

/// Where a record fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capacity {
    /// The lowest level at which it fails.
    pub lowest: f64,
    /// The highest level at which it fails.
    pub highest: f64,
    /// It stands at some level above its lowest failing one.
    pub stands_again: bool,
}

impl Capacity {
    /// That of a record; none where it never fails.
    pub fn of(runs: &[Run]) -> Option<Capacity> {
        let failing = || runs.iter().filter(|run| run.failed).map(|run| run.level);
        let (lowest, highest) = (failing().reduce(f64::min)?, failing().reduce(f64::max)?);
        let stands_again = runs.iter().any(|run| !run.failed && run.level > lowest);
        Some(Capacity { lowest, highest, stands_again })
    }
}

/// The share, by weight, of the records that fail at all which stand again above their lowest failing level; none where
/// no motion fails.
pub fn share_that_stands_again(records: &[RecordRuns]) -> Option<f64> {
    let (mut fail, mut again) = (0.0, 0.0);
    for record in weighed(records) {
        if let Some(capacity) = Capacity::of(&record.runs) {
            fail += record.weight;
            again += if capacity.stands_again { record.weight } else { 0.0 };
        }
    }
    (fail > 0.0).then(|| again / fail)
}
