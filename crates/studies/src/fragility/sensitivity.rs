//! What numbers that are not known add to a fragility, and which of them matter.

use super::Lognormal;
use super::limit_state::LimitState;
use super::runs::{Pool, RecordRuns};
use super::stripes;
use super::suite_runs::SuiteRuns;
use crate::statistics::quantile::Sorted;
use crate::suites::wanted::WantedMotion;
use crate::uncertain::{Design, Index, Varied, indices};
use topple::scene::Parameter;
use topple::stepping::outcome::Class;
use topple::work::parallel;

/// Numbers that are not known, and the points at which each motion is swept.
#[derive(Debug, Clone)]
pub struct Unknown {
    /// The numbers.
    pub varied: Vec<Varied>,
    /// Saltelli's design; its first two sets are points drawn by themselves.
    pub design: Design,
}

/// The sensitivity of a limit state of a cell.
#[derive(Debug, Clone)]
pub struct Sensitivity {
    /// What each number explains of the variance of the share of all runs that fail.
    pub indices: Vec<Index>,
    /// The fragility at each of the points that are drawn, by multiple stripes; none where it has no curve.
    pub curves: Vec<Option<Lognormal>>,
}

impl Unknown {
    /// The design of a given number of samples.
    pub fn of(varied: Vec<Varied>, samples: usize, seed: u32) -> Unknown {
        let design = Design::of(&varied, samples, seed);
        Unknown { varied, design }
    }

    /// Points at which each motion is swept.
    pub fn points(&self) -> usize {
        self.design.rows().count()
    }

    /// Points that are drawn by themselves: the others share numbers with them.
    pub fn drawn(&self) -> usize {
        self.design.a.len() + self.design.b.len()
    }

    /// Each motion at every point, one after the other.
    pub fn spread(&self, motions: Vec<WantedMotion>) -> Vec<WantedMotion> {
        let parameters: Vec<Parameter> = self.varied.iter().map(|one| one.parameter).collect();
        let points: Vec<Vec<f64>> = self.design.rows().cloned().collect();
        WantedMotion::spread(&motions, &parameters, points.iter())
    }

    /// The sensitivity of a limit state of a cell.
    pub fn sensitivity(&self, shaken: &SuiteRuns, state: LimitState, cell: usize) -> Sensitivity {
        let shares: Vec<f64> =
            (0..self.points()).map(|point| share(shaken, state, cell, point)).collect();
        let n = self.design.a.len();
        let (a, rest) = shares.split_at(n);
        let (b, rest) = rest.split_at(n);
        let ab: Vec<Vec<f64>> = rest.chunks(n).map(<[f64]>::to_vec).collect();
        let curve = |point: usize| {
            let one = point..point + 1;
            let records: Vec<RecordRuns> = shaken.records(state, cell, one);
            let fit = stripes::fit(&Pool::of(&records, |run| run.failed).stripes(None));
            fit.curve().map(|curve| curve.lognormal())
        };
        Sensitivity {
            indices: indices(a, b, &ab, 0),
            curves: parallel::each(self.drawn(), 1, curve),
        }
    }
}

impl Sensitivity {
    /// Of the curves the median beta, that of the records alone, and the deviation of ln theta, that of the numbers
    /// alone; none where fewer than two have a curve.
    pub fn shares_of_beta(&self) -> Option<(f64, f64)> {
        let curves: Vec<&Lognormal> = self.curves.iter().flatten().collect();
        if curves.len() < 2 {
            return None;
        }
        let median = Sorted::of(curves.iter().map(|curve| curve.beta).collect()).quantile(0.5)?;
        let logarithms = || curves.iter().map(|curve| curve.theta.ln());
        let mean = logarithms().sum::<f64>() / curves.len() as f64;
        let square = logarithms().map(|value| (value - mean).powi(2)).sum::<f64>();
        Some((median, (square / (curves.len() - 1) as f64).sqrt()))
    }
}

/// The share of all runs at a point that fail, by the weights of the motions.
fn share(shaken: &SuiteRuns, state: LimitState, cell: usize, point: usize) -> f64 {
    let cells = shaken.sweep.grid.len();
    let (mut failed, mut all) = (0.0, 0.0);
    for motion in shaken.sweep.motions.iter().skip(point).step_by(shaken.times) {
        for index in (cell..motion.outcomes.len()).step_by(cells) {
            if motion.outcomes[index] != Class::Unresolved {
                all += motion.weight;
                failed += if state.is_exceeded(motion, index) { motion.weight } else { 0.0 };
            }
        }
    }
    if all > 0.0 { failed / all } else { f64::NAN }
}
