//! The fragility of a grid's cells under a suite: every limit state by every estimator.

use super::capacity::{Capacity, share_that_stands_again};
use super::estimate::{Estimate, Estimator, estimate};
use super::hazard::HazardCurve;
use super::limit_state::LimitState;
use super::order::{self, Crossing};
use super::rates;
use super::runs::{Pool, RecordRuns, Run, Stripe};
use super::sensitivity::{Sensitivity, Unknown};
use super::suite_runs::SuiteRuns;
use crate::statistics::Bootstrap;
use crate::study::Study;
use crate::suites::intensity::Intensity;
use crate::suites::swept::SuiteSweep;
use crate::suites::{Falling, Groups};
use crate::uncertain::Varied;
use topple::scene::Scene;
use topple::work::observer::{Observer, Phase};
use topple::work::parallel;

/// What a study estimates, and how.
#[derive(Debug, Clone)]
pub struct StudySettings {
    /// The measure of the fragility.
    pub im: Intensity,
    /// Levels at which the ground accelerates downwards by more than g.
    pub falling: Option<Falling>,
    /// The level of each motion at each of its factors.
    pub levels: Vec<Vec<f64>>,
    /// Motions of each record: more than one where numbers vary. They follow each other.
    pub times: usize,
    /// Of these the first that count: the others tell which number matters.
    pub drawn: usize,
    /// Numbers that are not known.
    pub unknown: Option<Unknown>,
    /// The limit states.
    pub states: Vec<LimitState>,
    /// How fragilities are estimated.
    pub estimators: Vec<Estimator>,
    /// How intervals are.
    pub bootstrap: Bootstrap,
    /// Which records are drawn together.
    pub groups: Groups,
    /// The hazard of the site, where annual rates are wanted.
    pub hazard: Option<HazardCurve>,
    /// The annual rate that is accepted.
    pub target: Option<f64>,
}

/// The cells of a grid under a suite, with what is estimated of each.
#[derive(Debug)]
pub struct FragilityStudy {
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
    /// The annual rate by the shares of the runs alone, where there is a hazard curve.
    pub empirical: Option<f64>,
    /// The sensitivity to the numbers that vary.
    pub sensitivity: Option<Sensitivity>,
}

impl Study for FragilityStudy {
    type Settings = StudySettings;

    fn of(
        sweep: SuiteSweep,
        settings: StudySettings,
        observer: &dyn Observer,
    ) -> Option<FragilityStudy> {
        observer.begins(Phase::Fitting, sweep.grid.len() * settings.states.len());
        let (levels, groups) = (&settings.levels, &settings.groups.of);
        let shaken = SuiteRuns { sweep: &sweep, levels, times: settings.times, groups };
        let hazard = settings.hazard.as_ref();
        let cell = |cell: usize| {
            let mut states = Vec::with_capacity(settings.states.len());
            for state in &settings.states {
                if observer.cancelled() {
                    return None;
                }
                let records = shaken.records(*state, cell, 0..settings.drawn);
                let bootstrap = &settings.bootstrap;
                let by = |estimator: &Estimator| estimate(*estimator, &records, bootstrap, hazard);
                let estimates = settings.estimators.iter().map(by).collect();
                let unknown = settings.unknown.as_ref();
                let sensitivity = unknown.map(|unknown| unknown.sensitivity(&shaken, *state, cell));
                let stripes = Pool::of(&records, |run| run.failed).stripes(None);
                let empirical = hazard.and_then(|hazard| rates::empirical(&stripes, hazard));
                states.push(StateStudy {
                    counts: counts(&records),
                    stripes,
                    empirical,
                    estimates,
                    sensitivity,
                });
                observer.advance(1);
            }
            hold_below(&mut states, &settings);
            let overturning = shaken.records(LimitState::Overturning, cell, 0..settings.drawn);
            Some(CellStudy {
                states,
                capacities: overturning.iter().map(|record| Capacity::of(&record.runs)).collect(),
                stands_again: share_that_stands_again(&overturning),
                unresolved: shaken.unresolved(cell),
            })
        };
        let cells = parallel::each(sweep.grid.len(), 1, cell).into_iter().collect::<Option<_>>()?;
        Some(FragilityStudy { sweep, settings, cells })
    }

    fn sweep(&mut self) -> &mut SuiteSweep {
        &mut self.sweep
    }
}

impl FragilityStudy {
    /// Where curves of ordered limit states cross in a cell, by the first estimator.
    pub fn crossings(&self, cell: usize) -> Vec<Crossing> {
        let fits: Vec<&Estimate> =
            self.cells[cell].states.iter().map(|state| &state.estimates[0]).collect();
        order::crossings(&self.settings.states, &fits, self.settings.hazard.as_ref())
    }

    /// The scene under the first motion without the numbers that are not known.
    pub fn known(&self) -> Scene {
        let unknown = self.settings.unknown.as_ref();
        Varied::fixed(&self.sweep.scene, unknown.map_or(&[], |unknown| &unknown.varied))
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

/// Gives the rates of a cell what they are where curves of ordered limit states do not cross.
fn hold_below(states: &mut [StateStudy], settings: &StudySettings) {
    let Some(hazard) = &settings.hazard else { return };
    for estimator in 0..settings.estimators.len() {
        let fits: Vec<&Estimate> = states.iter().map(|state| &state.estimates[estimator]).collect();
        let ordered = order::ordered(&settings.states, &fits, hazard);
        for (state, ordered) in states.iter_mut().zip(ordered) {
            if let Some(rate) = &mut state.estimates[estimator].rate {
                rate.ordered = ordered;
            }
        }
    }
}

/// How many runs there are at each level, and how many of them exceed the state.
fn counts(records: &[RecordRuns]) -> Vec<(f64, usize, usize)> {
    let mut runs: Vec<&Run> = records.iter().flat_map(|record| &record.runs).collect();
    runs.sort_by(|a, b| a.level.total_cmp(&b.level));
    let levels = runs.chunk_by(|a, b| a.level == b.level);
    levels.map(|at| (at[0].level, at.len(), at.iter().filter(|run| run.failed).count())).collect()
}
