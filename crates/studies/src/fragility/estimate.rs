//! One call for every estimator: the curve, its interval, and why there is none.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::cloud::Cloud;
use super::curve::{Curve, Lognormal};
use super::fit::{Fit, Gap};
use super::hazard::HazardCurve;
use super::ida::Capacities;
use super::interval;
use super::profile::{self, Bounds};
use super::rates::{self, RateEstimate};
use super::runs::{Pool, RecordRuns, Run, Stripe, Weighed, weighed};
use super::stripes;
use crate::statistics::Bootstrap;

topple::written! {
    /// How a fragility is estimated.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
    pub enum Estimator {
        /// Multiple stripes: every run counts at its level.
        Stripes = "stripes",
        /// Incremental dynamic analysis: each record's lowest failing level is its capacity.
        Ida = "ida",
        /// A regression of the demand on those that stand, and the share of those that collapse.
        Cloud = "cloud",
    }
}

/// A fragility with its uncertainty. A bound that is none is open; where the median is none, nothing is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The median; in separable data the geometric middle of the gap.
    pub theta: Option<f64>,
    /// Lower bound of its 95 % interval.
    pub theta_low: Option<f64>,
    /// Upper bound.
    pub theta_high: Option<f64>,
    /// The standard deviation of the logarithm; none in separable data.
    pub beta: Option<f64>,
    /// Lower bound of its 95 % interval.
    pub beta_low: Option<f64>,
    /// Upper bound.
    pub beta_high: Option<f64>,
    /// A level separates standing from failing: the interval is that of the profile likelihood of the stripes, whatever
    /// the estimator; none where all records are one group.
    pub separable: bool,
    /// Resampled sets without a curve.
    pub without_fit: usize,
    /// What a reader of the numbers must know, if anything.
    pub note: Option<Note>,
    /// The curve that rates are made of; of separable data a step, where levels on both sides tell it.
    pub curve: Option<Curve>,
    /// The annual rate over a hazard curve, where there is one.
    pub rate: Option<RateEstimate>,
}

/// Why a number is missing, or is to be read with care.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Note {
    /// A level separates standing from failing.
    Separable(Gap),
    /// Failures do not become more likely with the level.
    NotIncreasing,
    /// Fewer than two motions fail.
    TooFewFailed,
    /// Too few runs that stand have a demand.
    TooFewDemands,
    /// There is no run.
    NoRuns,
    /// All runs are at one level.
    OneLevel,
    /// Some resampled sets have no curve.
    WithoutFit {
        /// How many.
        count: usize,
        /// Of how many.
        of: usize,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::Separable(Gap { stands: Some(stands), fails: Some(fails) }) => {
                let [stands, fails] = [*stands, *fails].map(four_digits);
                match stands == fails {
                    true => write!(out, "some runs stand and some fail at {stands} alone")?,
                    false => write!(
                        out,
                        "no run fails up to {stands}, and every run fails from {fails} on"
                    )?,
                }
                write!(out, ": no beta above zero fits best")
            }
            Note::Separable(Gap { stands: Some(stands), fails: None }) => {
                write!(out, "no run fails up to the highest level, {}", four_digits(*stands))
            }
            Note::Separable(Gap { stands: None, fails: Some(fails) }) => {
                write!(out, "every run fails from the lowest level on, {}", four_digits(*fails))
            }
            Note::Separable(Gap { stands: None, fails: None }) | Note::NoRuns => {
                write!(out, "there is no run")
            }
            Note::OneLevel => write!(out, "all runs are at one level; more levels tell a curve"),
            Note::NotIncreasing => write!(out, "the probability does not rise with the level"),
            Note::TooFewFailed => write!(out, "fewer than two motions fail"),
            Note::TooFewDemands => write!(
                out,
                "fewer than three runs that stand have a demand, or all of them are at one level"
            ),
            Note::WithoutFit { count, of } => {
                write!(out, "{count} of {of} resampled sets have no curve")
            }
        }
    }
}

/// A level as people read it.
fn four_digits(level: f64) -> String {
    let rounded: f64 = format!("{level:.3e}").parse().unwrap_or(level);
    match (1.0e-3..1.0e6).contains(&rounded) {
        true => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

/// Records prepared for an estimator.
enum Prepared {
    Stripes(Pool),
    Ida(Capacities),
    Cloud(Cloud),
}

impl Prepared {
    fn of(estimator: Estimator, records: &[Weighed]) -> Prepared {
        match estimator {
            Estimator::Stripes => Prepared::Stripes(Pool::of_weighed(records, failed)),
            Estimator::Ida => Prepared::Ida(Capacities::of_weighed(records)),
            Estimator::Cloud => Prepared::Cloud(Cloud::of_weighed(records)),
        }
    }

    /// The fit of records counted as often as multipliers say, from a curve that is near.
    fn fit(&self, times: Option<&[u32]>, near: Option<Lognormal>) -> Fit {
        match self {
            Prepared::Stripes(pool) => stripes::fit_near(&pool.stripes(times), near),
            Prepared::Ida(capacities) => capacities.fit_near(times, near),
            Prepared::Cloud(cloud) => cloud.fit_resampled(times),
        }
    }
}

fn failed(run: &Run) -> bool {
    run.failed
}

/// The fragility of records by an estimator, and its annual rate over a hazard curve. Its intervals come from resampling the
/// groups of the records; those of separable data from the profile likelihood of their stripes, in which records of a group
/// count together as one.
pub fn estimate(
    estimator: Estimator,
    records: &[RecordRuns],
    bootstrap: &Bootstrap,
    hazard: Option<&HazardCurve>,
) -> Estimate {
    let records = weighed(records);
    let mut levels = records.iter().flat_map(|record| &record.runs).map(|run| run.level);
    let first = levels.next();
    if let Some(first) = first
        && levels.all(|level| level == first)
    {
        return Estimate { note: Some(Note::OneLevel), ..Estimate::NONE };
    }
    let prepared = Prepared::of(estimator, &records);
    let stripes = || Pool::of_weighed(&records, failed).stripes(None);
    let groups: Vec<usize> = records.iter().map(|record| record.group).collect();
    let note = match prepared.fit(None, None) {
        Fit::Fitted(curve) => {
            let rate = hazard.map(|hazard| RateEstimate::of_curve(&curve, &stripes(), hazard));
            return resampled(curve, &groups, bootstrap, (hazard, rate), &prepared);
        }
        Fit::Separable(gap) => {
            let (_, count) = interval::dense(&groups);
            // As of a curve, one group alone tells no interval.
            let independent = (count > 1).then(|| count as f64 / groups.len() as f64);
            return separable(gap, &stripes(), independent, hazard);
        }
        Fit::NotIncreasing => Note::NotIncreasing,
        Fit::TooFewFailed => Note::TooFewFailed,
        Fit::TooFewDemands => Note::TooFewDemands,
        Fit::NoRuns => Note::NoRuns,
    };
    Estimate { note: Some(note), ..Estimate::NONE }
}

fn resampled(
    curve: Curve,
    groups: &[usize],
    bootstrap: &Bootstrap,
    (hazard, rate): (Option<&HazardCurve>, Option<RateEstimate>),
    prepared: &Prepared,
) -> Estimate {
    let refit = |times: &[u32]| prepared.fit(Some(times), Some(curve.lognormal()));
    let interval = interval::bootstrap(groups, bootstrap, curve, hazard, refit);
    let note = Note::WithoutFit { count: interval.without_fit, of: bootstrap.replicates as usize };
    let [low, high] = interval.rate;
    Estimate {
        theta: Some(curve.theta),
        theta_low: interval.theta[0],
        theta_high: interval.theta[1],
        beta: Some(curve.beta),
        beta_low: interval.beta[0],
        beta_high: interval.beta[1],
        separable: false,
        without_fit: interval.without_fit,
        note: (interval.without_fit > 0).then_some(note),
        curve: Some(curve),
        rate: rate.map(|rate| RateEstimate { low, high, ..rate }),
    }
}

/// `independent` is the share of the records that count as independent of each other; none where they tell no interval.
fn separable(
    gap: Gap,
    stripes: &[Stripe],
    independent: Option<f64>,
    hazard: Option<&HazardCurve>,
) -> Estimate {
    let bounds = independent.map_or(Bounds::NONE, |share| {
        let counted =
            |one: &Stripe| Stripe { level: one.level, n: share * one.n, z: share * one.z };
        profile::bounds(&stripes.iter().map(counted).collect::<Vec<_>>())
    });
    let within = independent.map(|_| (bounds.theta, bounds.beta_high));
    Estimate {
        theta: gap.middle(),
        theta_low: bounds.theta[0],
        theta_high: bounds.theta[1],
        beta_low: gap.middle().and(independent).map(|_| 0.0),
        beta_high: bounds.beta_high,
        separable: true,
        note: Some(Note::Separable(gap)),
        curve: rates::step(gap, stripes).map(Curve::step),
        rate: hazard.map(|hazard| RateEstimate::of_gap(gap, within, stripes, hazard)),
        ..Estimate::NONE
    }
}

impl Estimate {
    const NONE: Estimate = Estimate {
        theta: None,
        theta_low: None,
        theta_high: None,
        beta: None,
        beta_low: None,
        beta_high: None,
        separable: false,
        without_fit: 0,
        note: None,
        curve: None,
        rate: None,
    };
}
