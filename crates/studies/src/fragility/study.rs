//! The fragility of a grid's cells under a suite: every limit state by every estimator.

use rayon::prelude::*;

use super::capacity::{Capacity, share_that_stands_again};
use super::estimate::{Estimate, Estimator, estimate};
use super::limit_state::LimitState;
use super::runs::{Pool, RecordRuns, Run, Stripe};
use super::sensitivity::{Sensitivity, Unknown};
use super::suite_runs::SuiteRuns;
use crate::statistics::Bootstrap;
use crate::suites::swept::SuiteSweep;
use topple::work::observer::{Observer, Phase};
use topple::work::threads::install;

/// What a study estimates, and how.
#[derive(Debug, Clone)]
pub struct StudySettings {
    /// The level of each motion at each of its factors.
    pub levels: Vec<Vec<f64>>,
    /// Motions of each record: more than one where numbers vary. They follow each other.
    pub times: usize,
    /// Of these the first that count: the others tell which number matters.
    pub drawn: usize,
    /// Numbers that are not known.
    pub unknown: Option<Unknown>,
    /// What the block is not to do.
    pub states: Vec<LimitState>,
    /// How fragilities are estimated.
    pub estimators: Vec<Estimator>,
    /// How intervals are.
    pub bootstrap: Bootstrap,
}

/// The cells of a grid under a suite, with what is estimated of each.
#[derive(Debug)]
pub struct Study {
    /// The sweeps that it was made of.
    pub sweep: SuiteSweep,
    /// What is estimated of them, and how.
    pub settings: StudySettings,
    /// A cell each, in the grid's order.
    pub cells: Vec<CellStudy>,
}

/// What is estimated of a cell.
#[derive(Debug, Clone)]
pub struct CellStudy {
    /// A limit state each.
    pub states: Vec<StateStudy>,
    /// Where each record overturns it, by the record's number; none where it never does.
    pub capacities: Vec<Option<Capacity>>,
    /// The share of the records that overturn it which stand again at a higher level.
    pub stands_again: Option<f64>,
    /// Runs of which nothing is known.
    pub unresolved: usize,
}

/// A limit state of a cell.
#[derive(Debug, Clone)]
pub struct StateStudy {
    /// Levels by ascending value: how many runs there are at each, and how many of them exceed the state.
    pub counts: Vec<(f64, usize, usize)>,
    /// The same with the weights of the records, as they are fitted.
    pub stripes: Vec<Stripe>,
    /// What each estimator says.
    pub estimates: Vec<Estimate>,
    /// What is not known, where numbers vary.
    pub sensitivity: Option<Sensitivity>,
}

impl Study {
    /// Estimates the fragility of every cell; none where `observer` ends it.
    pub fn of(
        sweep: SuiteSweep,
        settings: StudySettings,
        observer: &dyn Observer,
    ) -> Option<Study> {
        observer.begins(Phase::Fitting, sweep.grid.len() * settings.states.len());
        let shaken = SuiteRuns { sweep: &sweep, levels: &settings.levels, times: settings.times };
        let cell = |cell: usize| {
            let mut states = Vec::with_capacity(settings.states.len());
            for state in &settings.states {
                if observer.cancelled() {
                    return None;
                }
                let records = shaken.records(*state, cell, 0..settings.drawn);
                let by =
                    |estimator: &Estimator| estimate(*estimator, &records, &settings.bootstrap);
                let estimates = settings.estimators.iter().map(by).collect();
                let unknown = settings.unknown.as_ref();
                let sensitivity = unknown.map(|unknown| unknown.sensitivity(&shaken, *state, cell));
                let stripes = Pool::of(&records, |run| run.failed).stripes(None);
                states.push(StateStudy {
                    counts: counts(&records),
                    stripes,
                    estimates,
                    sensitivity,
                });
                observer.advance(1);
            }
            let overturning = shaken.records(LimitState::Overturning, cell, 0..settings.drawn);
            Some(CellStudy {
                states,
                capacities: overturning.iter().map(|record| Capacity::of(&record.runs)).collect(),
                stands_again: share_that_stands_again(&overturning),
                unresolved: shaken.unresolved(cell),
            })
        };
        let all = (0..sweep.grid.len()).into_par_iter().map(cell);
        let cells = install(|| all.collect::<Option<Vec<_>>>())?;
        Some(Study { sweep, settings, cells })
    }

    /// True where records count differently.
    pub fn is_weighted(&self) -> bool {
        self.sweep.motions.windows(2).any(|pair| pair[0].weight != pair[1].weight)
    }

    /// The ids of the records.
    pub fn records(&self) -> impl Iterator<Item = &str> {
        self.sweep.motions.iter().step_by(self.settings.times).map(|motion| motion.id.as_str())
    }
}

/// How many runs there are at each level, and how many of them exceed the state.
fn counts(records: &[RecordRuns]) -> Vec<(f64, usize, usize)> {
    let mut runs: Vec<&Run> = records.iter().flat_map(|record| &record.runs).collect();
    runs.sort_by(|a, b| a.level.total_cmp(&b.level));
    let levels = runs.chunk_by(|a, b| a.level == b.level);
    levels.map(|at| (at[0].level, at.len(), at.iter().filter(|run| run.failed).count())).collect()
}
