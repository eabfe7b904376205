//! The runs of a cell of a suite's sweep, a record each.

use std::ops::Range;

use super::limit_state::LimitState;
use super::runs::{RecordRuns, Run};
use crate::suites::swept::SuiteSweep;
use crate::suites::swept_motion::SweptMotion;
use topple::stepping::outcome::Class;

/// A suite's sweep with the levels of its motions.
#[derive(Debug, Clone, Copy)]
pub struct SuiteRuns<'a> {
    /// The sweep.
    pub sweep: &'a SuiteSweep,
    /// The level of each motion at each of its factors.
    pub levels: &'a [Vec<f64>],
    /// Motions of each record: more than one where numbers vary. They follow each other.
    pub times: usize,
    /// The group of each record.
    pub groups: &'a [usize],
}

/// The run of a cell of a motion at a level, by its place among all levels; none where it is unresolved.
pub fn run_of(state: LimitState, motion: &SweptMotion, index: usize, level: f64) -> Option<Run> {
    let class = motion.outcomes[index];
    (class != Class::Unresolved).then(|| Run {
        level,
        failed: state.is_exceeded(motion, index),
        demand: state.demand(motion, index),
        collapsed: class.overturned(),
    })
}

impl SuiteRuns<'_> {
    /// The runs of a cell under some motions of each record; those that are unresolved are left out.
    pub fn records(&self, state: LimitState, cell: usize, range: Range<usize>) -> Vec<RecordRuns> {
        let cells = self.sweep.grid.len();
        let motions = self.sweep.motions.chunks(self.times).map(|motions| &motions[range.clone()]);
        let levels = self.levels.chunks(self.times).map(|levels| &levels[range.clone()]);
        let of_record = |((motions, levels), group): ((&[SweptMotion], &[Vec<f64>]), &usize)| {
            let runs = motions.iter().zip(levels).flat_map(|(motion, levels)| {
                levels
                    .iter()
                    .enumerate()
                    .filter_map(move |(k, level)| run_of(state, motion, k * cells + cell, *level))
            });
            let mut runs: Vec<Run> = runs.collect();
            runs.sort_by(|a, b| a.level.total_cmp(&b.level));
            RecordRuns { weight: motions[0].weight, group: *group, runs }
        };
        motions.zip(levels).zip(self.groups).map(of_record).collect()
    }

    /// Runs of a cell of which nothing is known.
    pub fn unresolved(&self, cell: usize) -> usize {
        let cells = self.sweep.grid.len();
        let of = |motion: &SweptMotion| {
            let outcomes = motion.outcomes.iter().skip(cell).step_by(cells);
            outcomes.filter(|class| **class == Class::Unresolved).count()
        };
        self.sweep.motions.iter().map(of).sum()
    }
}
