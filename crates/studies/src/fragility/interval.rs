//! Intervals by resampling records.

use super::curve::{Curve, is_level};
use super::fit::Fit;
use super::hazard::HazardCurve;
use crate::statistics::Bootstrap;
use crate::statistics::bca::{FEWEST, acceleration, ends};
use topple::work::parallel;

/// Sets that a thread takes at once: fewer cost more to hand over than to fit.
const AT_ONCE: usize = 32;

/// What resampling gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower and upper bound of theta; none where it is open at that end.
    pub theta: [Option<f64>; 2],
    /// Those of beta.
    pub beta: [Option<f64>; 2],
    /// Those of the annual rate over a hazard curve.
    pub rate: [Option<f64>; 2],
    /// Sets without a curve.
    pub without_fit: usize,
}

/// Draws sets of as many groups of records with replacement, fits each, and takes the ends of theta, beta and the annual
/// rate, corrected for bias and acceleration ([`ends`]); for the acceleration each group is left out once. The plain percentiles
/// are too low for beta, which resampling makes smaller.
///
/// Groups are drawn, not runs or records: the runs of a record belong together, and so do records of an event. `groups` has the
/// group of each record; `refit` gets how often each record is drawn. One group alone tells no interval.
///
/// A set without a curve says something where it is separable: a gap with two ends counts with its middle and with a beta
/// of zero, which are the limits of the likelihood; a set in which none fails counts as theta without bound, one
/// in which all fail as theta of zero, both without a beta. Left out, they would make the interval too narrow on that
/// side. An interval that reaches such a theta is open there. The other sets without a curve do not count. Sets that all say
/// the same tell no interval: one without a width would say that the number is known.
pub fn bootstrap(
    groups: &[usize],
    settings: &Bootstrap,
    estimate: Curve,
    hazard: Option<&HazardCurve>,
    refit: impl Fn(&[u32]) -> Fit + Sync,
) -> Interval {
    let (of, count) = dense(groups);
    let records = |times: &[u32]| of.iter().map(|group| times[*group]).collect::<Vec<_>>();
    let draw = |replicate: usize| {
        // The number of replicates is of 32 bits.
        let fit = refit(&records(&settings.multipliers(count, replicate as u32)));
        Drawn::of(&fit, hazard)
    };
    let drawn: Vec<Drawn> = parallel::each(settings.replicates as usize, AT_ONCE, draw);
    let without_fit = drawn.iter().filter(|drawn| !drawn.fitted).count();
    let open = Interval { theta: [None; 2], beta: [None; 2], rate: [None; 2], without_fit };
    if count < 2 || drawn.iter().filter_map(|drawn| drawn.theta).count() < FEWEST as usize {
        return open;
    }
    let without = |left_out: usize| {
        let times: Vec<u32> = (0..count).map(|group| u32::from(group != left_out)).collect();
        Drawn::of(&refit(&records(&times)), hazard)
    };
    let left: Vec<Drawn> = parallel::each(count, AT_ONCE, without);
    let interval = |value: fn(&Drawn) -> Option<f64>, estimate: f64| {
        let values = |of: &[Drawn]| of.iter().filter_map(value).collect::<Vec<_>>();
        match ends(values(&drawn), estimate, acceleration(&values(&left))) {
            [Some(low), Some(high)] if low == high => [None; 2],
            ends => ends,
        }
    };
    let theta = interval(|drawn| drawn.theta, estimate.theta)
        .map(|theta| theta.filter(|theta| is_level(*theta)));
    let rate =
        hazard.map_or([None; 2], |hazard| interval(|drawn| drawn.rate, hazard.rate(estimate).rate));
    Interval { theta, beta: interval(|drawn| drawn.beta, estimate.beta), rate, without_fit }
}

/// Groups by numbers without gaps, and how many there are.
pub(super) fn dense(groups: &[usize]) -> (Vec<usize>, usize) {
    let mut known = groups.to_vec();
    known.sort_unstable();
    known.dedup();
    let place = |group: &usize| known.partition_point(|other| other < group);
    (groups.iter().map(place).collect(), known.len())
}

/// What a resampled set says.
#[derive(Debug, Clone, Copy)]
struct Drawn {
    fitted: bool,
    theta: Option<f64>,
    beta: Option<f64>,
    rate: Option<f64>,
}

impl Drawn {
    fn of(fit: &Fit, hazard: Option<&HazardCurve>) -> Drawn {
        let (theta, beta) = match fit {
            Fit::Fitted(curve) => (Some(curve.theta), Some(curve.beta)),
            Fit::Separable(gap) => match (gap.stands, gap.fails) {
                (Some(_), Some(_)) => (gap.middle(), Some(0.0)),
                (Some(_), None) => (Some(f64::INFINITY), None),
                (None, _) => (Some(0.0), None),
            },
            _ => (None, None),
        };
        // A step at zero or without bound takes all of the hazard, or nothing.
        let step = |theta: f64| Curve::step(theta.clamp(f64::MIN_POSITIVE, f64::MAX));
        let curve = fit.curve().or(theta.map(step));
        let rate = hazard.zip(curve).map(|(hazard, curve)| hazard.rate(curve).rate);
        Drawn { fitted: fit.curve().is_some(), theta, beta, rate }
    }
}
