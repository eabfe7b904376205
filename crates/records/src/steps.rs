//! The common step of two components: the longest of which both steps are whole multiples.

use super::{DIGITS, rounded};

/// Shortest time between samples, s: a thousandth of the finest that is recorded on a shaking table.
pub(super) const SHORTEST_STEP: f64 = 1.0e-6;

/// How many steps of a pair are one of each component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Steps {
    pub parts: [usize; 2],
}

/// Most parts that the finer of two steps is cut into: of 0.01 s and 1/128 s it is 25.
const MOST_PARTS: usize = 64;
/// Most of a step by which one component may have run away from the other at its end.
const DRIFT: f64 = 0.02;

impl Steps {
    /// Those of one step.
    pub const ONE: Steps = Steps { parts: [1, 1] };

    /// Those of the longest step of which both are whole multiples, up to a drift that is none.
    pub fn of(dt: [f64; 2], lengths: [usize; 2]) -> Option<Steps> {
        let (fine, coarse) = if dt[0] <= dt[1] { (0, 1) } else { (1, 0) };
        let ratio = dt[coarse] / dt[fine];
        // As far as both go.
        let gaps = (lengths[coarse] as f64).min(lengths[fine] as f64 / ratio).max(1.0);
        let long_enough = |parts: &usize| dt[fine] / *parts as f64 >= SHORTEST_STEP;
        let found = (1..=MOST_PARTS).take_while(long_enough).find(|parts| {
            let whole = ratio * *parts as f64;
            (whole - whole.round()).abs() * gaps <= DRIFT * *parts as f64
        })?;
        let mut parts = [found; 2];
        parts[coarse] = (ratio * found as f64).round() as usize;
        Some(Steps { parts })
    }

    /// The step of a pair: that of a component in equal parts.
    pub fn step(self, horizontal: f64, vertical: Option<f64>) -> f64 {
        let [of_h, of_v] = self.parts;
        match vertical {
            // The finer one is cut into fewer parts.
            Some(vertical) if of_v < of_h => part(vertical, of_v),
            _ => part(horizontal, of_h),
        }
    }

    /// Samples of a pair of components of such lengths.
    pub fn count(self, lengths: [usize; 2]) -> u128 {
        let of = |length: usize, parts: usize| length.saturating_sub(1) as u128 * parts as u128;
        of(lengths[0], self.parts[0]).max(of(lengths[1], self.parts[1])) + 1
    }
}

/// A part of a step, without the last digits of the division.
fn part(step: f64, parts: usize) -> f64 {
    if parts == 1 { step } else { rounded(step / parts as f64, DIGITS) }
}

/// The value of samples, each a number of parts after the one before it, at a part: linear between, zero after the end.
pub(super) fn at(samples: &[f64], part: usize, parts: usize) -> f64 {
    let (before, within) = (part / parts, part % parts);
    match (samples.get(before), samples.get(before + 1)) {
        (Some(a), _) if within == 0 => *a,
        (Some(a), Some(b)) => a + (b - a) * (within as f64 / parts as f64),
        _ => 0.0,
    }
}
