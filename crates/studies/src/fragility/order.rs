//! Limit states of which one implies another: the curve of the first cannot be above that of the second.

use std::ops::Range;

use super::estimate::Estimate;
use super::fit::Lognormal;
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
    let curves: Vec<Option<Lognormal>> = fits.iter().map(|fit| fit.curve()).collect();
    let mut found = Vec::new();
    for (inner, outer) in pairs(states) {
        let (Some(one), Some(other)) = (curves[inner], curves[outer]) else { continue };
        let Some((level, probability, below)) = meet(&one, &other) else { continue };
        let share = hazard.and_then(|hazard| {
            let rate = hazard.rate(&one).rate;
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
        let (own, rate) = (fits[inner].curve()?, fits[inner].rate?.rate?);
        let outer = pairs(states).filter(|(one, _)| *one == inner);
        let others: Vec<Lognormal> = outer.filter_map(|(_, outer)| fits[outer].curve()).collect();
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

/// Where an inner curve is above an outer one: the level at which they meet, the probability there, and whether it is above
/// below that level. None where it nowhere is.
fn meet(inner: &Lognormal, outer: &Lognormal) -> Option<(Option<f64>, f64, bool)> {
    let (a, b) = (inner.theta.ln(), outer.theta.ln());
    if inner.beta == outer.beta {
        // The inner curve is above the outer one everywhere.
        return (a < b).then(|| (None, outer.probability(inner.theta).max(0.5), true));
    }
    let y = (a * outer.beta - b * inner.beta) / (outer.beta - inner.beta);
    let level = y.exp();
    let probability = match outer.beta > 0.0 {
        true => outer.probability(level),
        false => inner.probability(outer.theta),
    };
    Some((Some(level), probability, inner.beta > outer.beta))
}
