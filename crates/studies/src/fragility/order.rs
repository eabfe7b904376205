//! Limit states of which one implies another: the curve of the first cannot be above that of the second.

use std::ops::Range;

use super::curve::{Curve, Part};
use super::estimate::Estimate;
use super::hazard::HazardCurve;
use super::limit_state::LimitState;

/// A curve above that of a limit state that it implies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// The limit state that implies the other one, by its number.
    pub inner: usize,
    /// The other one.
    pub outer: usize,
    /// The level at which the curves meet; none where they never do.
    pub level: Option<f64>,
    /// The probability there, or where the outer curve is a step, that of the inner one beside it.
    pub probability: f64,
    /// True where the inner curve is above the outer one at lower levels, false at higher ones.
    pub below: bool,
    /// The share of the inner state's rate from above the outer curve; none without a hazard curve.
    pub share: Option<f64>,
}

/// Probabilities between which a crossing counts without a hazard curve.
const PROBABILITIES: Range<f64> = 1.0e-3..0.99;
/// Share of a rate from which on it counts.
const SHARE: f64 = 0.01;

/// True where a block that exceeds one limit state exceeds another one, too: overturning exceeds all; a rocking index above
/// zero has lifted; a larger limit of a quantity includes the smaller.
pub fn implies(one: LimitState, other: LimitState) -> bool {
    match (one, other) {
        _ if one == other => false,
        (LimitState::Overturning, _) => true,
        (LimitState::Zeta(_), LimitState::Uplift) => true,
        (LimitState::Zeta(one), LimitState::Zeta(other))
        | (LimitState::U(one), LimitState::U(other))
        | (LimitState::V(one), LimitState::V(other)) => one > other,
        _ => false,
    }
}

/// Where curves of ordered limit states cross so that it counts: by the share of the rate, or by the probability where there is no hazard.
/// `fits` has the estimates of each state by one estimator.
pub fn crossings(
    states: &[LimitState],
    fits: &[&Estimate],
    hazard: Option<&HazardCurve>,
) -> Vec<Crossing> {
    let curves: Vec<Option<Curve>> = fits.iter().map(|fit| fit.curve).collect();
    let mut found = Vec::new();
    for (inner, outer) in pairs(states) {
        let (Some(one), Some(other)) = (curves[inner], curves[outer]) else { continue };
        let Some((level, probability, below)) = meet(&one, &other) else { continue };
        let share = hazard.and_then(|hazard| {
            let rate = hazard.rate(one).rate;
            (rate > 0.0).then(|| hazard.excess(&one, &[other]) / rate)
        });
        let counts = match share {
            Some(share) => share > SHARE,
            None => PROBABILITIES.contains(&probability),
        };
        if counts {
            found.push(Crossing { inner, outer, level, probability, below, share });
        }
    }
    found
}

/// The rates of the estimates of one estimator, each curve held below those of all states that it implies.
pub(crate) fn ordered(
    states: &[LimitState],
    fits: &[&Estimate],
    hazard: &HazardCurve,
) -> Vec<Option<f64>> {
    let of = |inner: usize| {
        let (own, rate) = (fits[inner].curve?, fits[inner].rate?.rate?);
        let outer = pairs(states).filter(|(one, _)| *one == inner);
        let others: Vec<Curve> = outer.filter_map(|(_, outer)| fits[outer].curve).collect();
        Some(if others.is_empty() { rate } else { hazard.held_below(&own, &others) })
    };
    (0..states.len()).map(of).collect()
}

/// Numbers of states of which the first implies the second.
fn pairs(states: &[LimitState]) -> impl Iterator<Item = (usize, usize)> {
    (0..states.len()).flat_map(move |inner| {
        let implied = move |outer: &usize| implies(states[inner], states[*outer]);
        (0..states.len()).filter(implied).map(move |outer| (inner, outer))
    })
}

/// Points at which two curves are compared, from where one begins to change to where both have ended.
const POINTS: u32 = 2000;

/// Where an inner curve is above an outer one: the level at which they meet, the probability there, and whether it is above
/// below that level. None where it nowhere is. Of curves that meet several times it is the end of the part in which the inner one is farthest
/// above.
fn meet(inner: &Curve, outer: &Curve) -> Option<(Option<f64>, f64, bool)> {
    if let (Some(one), Some(other)) = (inner.only(), outer.only())
        && one.shape == other.shape
    {
        return lines(&one, &other).map(|(level, below)| told(inner, outer, level, below));
    }
    let parts = || inner.parts().chain(outer.parts());
    let low = parts().map(|part| part.ends()[0]).fold(f64::INFINITY, f64::min);
    let high = parts().map(|part| part.ends()[1]).fold(f64::NEG_INFINITY, f64::max);
    let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(POINTS);
    let over = |y: f64| inner.at(y) - outer.at(y);
    let above: Vec<f64> = (0..=POINTS).map(|k| over(at(k))).collect();
    let most = (0..=POINTS).max_by(|a, b| above[*a as usize].total_cmp(&above[*b as usize]))?;
    if above[most as usize] <= 0.0 {
        return None;
    }
    let ends = |k: &u32| above[*k as usize] < 0.0;
    // The end on the side of stronger motions, if there is one: below it the inner curve is above.
    let (end, step) = match (most..=POINTS).find(ends) {
        Some(end) => (end, -1.0),
        None => match (0..most).rev().find(ends) {
            Some(end) => (end, 1.0),
            None => return Some(told(inner, outer, None, true)),
        },
    };
    let (mut beyond, mut within) = (at(end), at((f64::from(end) + step) as u32));
    for _ in 0..60 {
        let middle = 0.5 * (beyond + within);
        if over(middle) < 0.0 { beyond = middle } else { within = middle }
    }
    Some(told(inner, outer, Some(within), step < 0.0))
}

/// Where one line of ln x is above another of the same shape: where they meet, none where they never do, and on which side. None where it
/// nowhere is.
fn lines(inner: &Part, outer: &Part) -> Option<(Option<f64>, bool)> {
    if inner.scale == outer.scale {
        // The inner curve is above the outer one everywhere.
        return (inner.at < outer.at).then_some((None, true));
    }
    let met = inner.at * outer.scale - outer.at * inner.scale;
    Some((Some(met / (outer.scale - inner.scale)), inner.scale > outer.scale))
}

/// A crossing at a logarithm of the level.
fn told(inner: &Curve, outer: &Curve, ln: Option<f64>, below: bool) -> (Option<f64>, f64, bool) {
    let probability = match ln {
        None => outer.probability(inner.theta).max(0.5),
        Some(ln) if outer.beta > 0.0 => outer.at(ln),
        Some(_) => inner.probability(outer.theta),
    };
    (ln.map(f64::exp), probability, below)
}
