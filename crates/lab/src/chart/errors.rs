//! How far a method is from the truth: four errors, for one number says too little where a system
//! switches.

use super::truth::Solution;
use topple::stepping::outcome::Class;
use topple_studies::statistics::quantile::Sorted;

/// A number over cells: where half of them are below, and where 99 of 100 are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The 99th percentile.
    pub p99: f64,
}

/// The errors of a method on a bench.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Cells.
    pub cells: usize,
    /// Cells without an outcome.
    pub failed: usize,
    /// Cells with another outcome than the truth's.
    pub differ: usize,
    /// Cells whose first switches are the truth's, in kind and order; none where they are not
    /// compared.
    pub sequences: Option<usize>,
    /// Error of a switch's time, s: the largest of a cell's first switches, over the cells whose
    /// switches agree and which have any.
    pub time: Option<Spread>,
    /// Error of the motion after an impact, the same way: the largest of its seven coordinates, in
    /// m, m/s, rad, rad/s.
    pub motion: Option<Spread>,
    /// Error of zeta, over the cells that rock, stand, and whose switches agree.
    pub zeta: Option<Spread>,
}

fn spread(values: Vec<f64>) -> Option<Spread> {
    let sorted = Sorted::of(values);
    Some(Spread { median: sorted.nearest(0.5)?, p99: sorted.nearest(0.99)? })
}

/// Largest error of the first switches' times and motions; none where their kinds differ.
fn of_switches(truth: &Solution, solution: &Solution) -> Option<(f64, f64)> {
    if truth.switches.len() != solution.switches.len() {
        return None;
    }
    let mut worst = (0.0_f64, 0.0_f64);
    for (a, b) in truth.switches.iter().zip(&solution.switches) {
        if a.kind != b.kind {
            return None;
        }
        worst.0 = worst.0.max((a.t - b.t).abs());
        for (x, y) in a.motion.iter().zip(b.motion) {
            worst.1 = worst.1.max((x - y).abs());
        }
    }
    Some(worst)
}

/// What of two solutions is compared beside their outcomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Compared {
    /// Their first switches.
    pub switches: bool,
    /// ζ.
    pub zeta: bool,
}

/// Compares the solutions of a method with the truth.
pub fn compare(truth: &[Solution], solutions: &[Solution], compared: Compared) -> Errors {
    let mut errors = Errors {
        cells: truth.len(),
        failed: 0,
        differ: 0,
        sequences: compared.switches.then_some(0),
        time: None,
        motion: None,
        zeta: None,
    };
    let (mut times, mut motions, mut zetas) = (Vec::new(), Vec::new(), Vec::new());
    for (a, b) in truth.iter().zip(solutions) {
        if b.outcome.class == Class::Unresolved {
            errors.failed += 1;
            continue;
        }
        if a.outcome.class != b.outcome.class {
            errors.differ += 1;
        }
        if compared.switches {
            let Some((time, motion)) = of_switches(a, b) else { continue };
            errors.sequences = errors.sequences.map(|count| count + 1);
            if !a.switches.is_empty() {
                times.push(time);
                motions.push(motion);
            }
        }
        if compared.zeta && a.outcome.class == Class::Rocking && b.outcome.class == Class::Rocking {
            zetas.push((a.outcome.zeta - b.outcome.zeta).abs());
        }
    }
    errors.time = spread(times);
    errors.motion = spread(motions);
    errors.zeta = spread(zetas);
    errors
}
