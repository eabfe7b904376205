//! What became of devices under a suite.

use super::devices::Device;
use super::settings::ComparisonSettings;
use super::shaken::Shaken;
use crate::fragility::limit_state::LimitState;
use crate::fragility::order::{self, Crossing};
use crate::fragility::runs::Pool;
use crate::fragility::suite_runs::run_of;
use crate::fragility::{Estimate, Estimator, HazardCurve, RecordRuns, Stripe, estimate, rates};
use crate::statistics::{Bootstrap, DrawnGroups};
use crate::study::Study;
use crate::suites::envelope::{CellEnvelope, Limits, percentiles, within};
use crate::suites::swept::SuiteSweep;
use crate::suites::swept_motion::SweptMotion;
use topple::results::columns::Column;
use topple::scene::Parameter;
use topple::stepping::outcome::Class;
use topple::work::observer::Observer;

/// Devices under a suite, with the results of each.
#[derive(Debug)]
pub struct Comparison {
    /// The sweep of all devices, one after the other.
    pub sweep: SuiteSweep,
    /// What is computed for them.
    pub settings: ComparisonSettings,
    /// A device each, in the list's order.
    pub devices: Vec<Compared>,
}

/// The outcome of a device.
#[derive(Debug, Clone)]
pub struct Compared {
    /// Shares and strokes under the motions as they are.
    pub cell: CellEnvelope,
    /// Share of the motions under which the block lifts, whether it stands or overturns.
    pub lifted: f64,
    /// Percentiles of the further columns, of the motions under which the block stands.
    pub columns: Vec<[f64; 3]>,
    /// Motions, as they are, under which the contact force is tensile: the model does not hold there.
    pub tensile: usize,
    /// The least factor on the motions at which one meets the end stop, of 1 and those of the reserve; none where none does.
    pub stop_from: Option<f64>,
    /// How much stronger the motions may be; none if it is not requested.
    pub reserve: Option<Reserve>,
    /// The annual rate of overturning; none without a hazard curve.
    pub rate: Option<Rated>,
}

/// An annual rate with what it stands on.
#[derive(Debug, Clone)]
pub struct Rated {
    /// The fragility, by multiple stripes, and its rate.
    pub estimate: Estimate,
    /// How many runs there are at each level, and how many overturn.
    pub stripes: Vec<Stripe>,
    /// The rate by the shares of the runs alone.
    pub empirical: Option<f64>,
    /// Where the curve is above that of uplift, which overturning implies; none where it is not.
    pub crossing: Option<Crossing>,
}

/// The limit states of an annual rate: that of the rate, and the one that it implies.
pub const STATES: [LimitState; 2] = [LimitState::Overturning, LimitState::Uplift];

/// How much stronger the motions may be, by the factors of the list and 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reserve {
    /// The largest factor up to which all limits are kept, at each before it, too; none where they are not kept at the least.
    pub keeps: Option<f64>,
    /// The least at which they are not; none where they are kept at all. The truth lies between both: nothing was run there.
    pub fails: Option<f64>,
}

impl Study for Comparison {
    type Settings = ComparisonSettings;

    fn of(sweep: SuiteSweep, settings: ComparisonSettings, _: &dyn Observer) -> Option<Comparison> {
        let ComparisonSettings { limits, groups, bootstrap, hazard, .. } = &settings;
        let drawn = DrawnGroups::of(&groups.of, groups.count, bootstrap);
        let each = (sweep.motions.len() / settings.devices.len().max(1)).max(1);
        let devices = sweep.motions.chunks(each).zip(settings.shaken.chunks(each));
        let devices = devices.zip(&settings.devices);
        let of_device = |((motions, shaken), device): ((&[SweptMotion], &[Shaken]), &Device)| {
            let has_stop = device.scene.numbers.has(Parameter::StopGap);
            let first = shaken.first()?;
            // All motions are as they are at one place only where their factors are the same: each is looked up.
            let plain = at(motions, shaken, |shaken| shaken.plain);
            let mut cell = CellEnvelope::of(&plain, 0, *limits);
            cell.overturned_within = within(&plain, 0, 1, &drawn);
            let lifts = |class: Class| class.overturned() || class == Class::Rocking;
            let all: f64 = plain.iter().map(|motion| motion.weight).sum();
            let lifted = plain.iter().filter(|motion| lifts(motion.outcomes[0]));
            let of_column =
                |k: usize| percentiles(&plain, 0, move |motion: &SweptMotion| motion.others[k][0]);
            let other = |column: Column| settings.others.iter().position(|other| *other == column);
            let tensile = other(Column::MinContact).map_or(0, |k| {
                let loses_contact = |motion: &&SweptMotion| {
                    motion.outcomes[0].loses_contact(motion.others[k][0].into())
                };
                plain.iter().filter(loses_contact).count()
            });
            let stop_from = other(Column::StopHits).filter(|_| has_stop).and_then(|k| {
                let hits = |place: &dyn Fn(&Shaken) -> usize| {
                    let mut all = motions.iter().zip(shaken);
                    all.any(|(motion, shaken)| motion.others[k][place(shaken)] > 0.0)
                };
                let at_scale = |(at, scale): (usize, &f64)| {
                    hits(&|shaken| shaken.scales[at]).then_some(*scale)
                };
                let scales = settings.scales.iter().enumerate().filter_map(at_scale);
                let plain = hits(&|shaken| shaken.plain).then_some(1.0);
                scales.chain(plain).min_by(f64::total_cmp)
            });
            let hazard = hazard.as_ref();
            Some(Compared {
                tensile,
                stop_from,
                cell,
                // A sum of nothing is a negative zero.
                lifted: lifted.fold(0.0, |sum, motion| sum + motion.weight) / all,
                columns: (0..settings.columns.len())
                    .map(|k| match settings.columns[k] {
                        // Nothing is known of a stop that is not there.
                        Column::StopForce | Column::StopHits if !has_stop => [f64::NAN; 3],
                        _ => of_column(k),
                    })
                    .collect(),
                reserve: (!first.scales.is_empty())
                    .then(|| reserve(motions, shaken, &settings.scales, *limits)),
                rate: hazard.map(|hazard| rate(motions, shaken, &groups.of, (hazard, bootstrap))),
            })
        };
        let devices = devices.filter_map(of_device).collect();
        Some(Comparison { sweep, settings, devices })
    }

    fn sweep(&mut self) -> &mut SuiteSweep {
        &mut self.sweep
    }
}

impl Comparison {
    /// How many motions each device has.
    pub fn records(&self) -> usize {
        self.sweep.motions.len() / self.settings.devices.len().max(1)
    }

    /// Each device with what became of it.
    pub fn rows(&self) -> impl Iterator<Item = (&str, &Compared)> {
        self.settings.devices.iter().map(|device| device.name.as_str()).zip(&self.devices)
    }
}

/// The motions at one factor each.
fn at(
    motions: &[SweptMotion],
    shaken: &[Shaken],
    place: impl Fn(&Shaken) -> usize,
) -> Vec<SweptMotion> {
    let one = |(motion, shaken): (&SweptMotion, &Shaken)| {
        let at = place(shaken);
        SweptMotion {
            id: motion.id.clone(),
            weight: motion.weight,
            outcomes: vec![motion.outcomes[at]],
            max_u: vec![motion.max_u[at]],
            stroke_v: vec![motion.stroke_v[at]],
            zeta: vec![motion.zeta[at]],
            others: motion.others.iter().map(|other| vec![other[at]]).collect(),
            verified: motion.verified.clone(),
        }
    };
    motions.iter().zip(shaken).map(one).collect()
}

/// How much stronger the motions may be: the factors of the list, and 1 among them, are gone up to the first at which a limit is
/// not kept. That the block stands again at a larger one is no reserve.
fn reserve(motions: &[SweptMotion], shaken: &[Shaken], scales: &[f64], limits: Limits) -> Reserve {
    let listed = scales.iter().enumerate().map(|(k, scale)| (*scale, Some(k)));
    let mut factors: Vec<(f64, Option<usize>)> = listed.chain([(1.0, None)]).collect();
    factors.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let keeps = |place: Option<usize>| {
        let place = |shaken: &Shaken| place.map_or(shaken.plain, |k| shaken.scales[k]);
        CellEnvelope::of(&at(motions, shaken, place), 0, limits).feasible
    };
    let fails = factors.iter().position(|(_, place)| !keeps(*place));
    let last = fails.unwrap_or(factors.len()).checked_sub(1);
    Reserve { keeps: last.map(|k| factors[k].0), fails: fails.map(|k| factors[k].0) }
}

/// The annual rate of overturning, by multiple stripes.
fn rate(
    motions: &[SweptMotion],
    shaken: &[Shaken],
    groups: &[usize],
    (hazard, bootstrap): (&HazardCurve, &Bootstrap),
) -> Rated {
    let records_of = |state: LimitState| -> Vec<RecordRuns> {
        let record = |((motion, shaken), group): ((&SweptMotion, &Shaken), &usize)| {
            let of = |(at, level): &(usize, f64)| run_of(state, motion, *at, *level);
            let mut runs: Vec<_> = shaken.levels.iter().filter_map(of).collect();
            runs.sort_by(|a, b| a.level.total_cmp(&b.level));
            RecordRuns { weight: motion.weight, group: *group, runs }
        };
        motions.iter().zip(shaken).zip(groups).map(record).collect()
    };
    let [records, implied] = STATES.map(records_of);
    let stripes = Pool::of(&records, |run| run.failed).stripes(None);
    let by = Estimator::Stripes;
    let mut estimated = estimate(by, &records, bootstrap, Some(hazard));
    // Of the state that is implied the curve alone is asked for.
    let uplift = estimate(by, &implied, &Bootstrap { replicates: 0, ..*bootstrap }, None);
    let crossing = order::crossings(&STATES, &[&estimated, &uplift], Some(hazard)).pop();
    let ordered = order::ordered(&STATES, &[&estimated, &uplift], hazard)[0];
    if let Some(rate) = &mut estimated.rate {
        rate.ordered = ordered;
    }
    Rated { estimate: estimated, empirical: rates::empirical(&stripes, hazard), stripes, crossing }
}
