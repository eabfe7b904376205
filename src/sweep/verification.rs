//! A sample of a sweep's cells, run again by the reference.

use rayon::prelude::*;
use serde::Serialize;

use crate::integrate::outcome::{Class, Outcome};
use crate::integrate::reference::{self, Settings};
use crate::scene::Grid;

use super::plan::Plan;

/// Cells that are run again by default.
pub const SAMPLE: usize = 128;

/// A cell on which sweep and reference disagree.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// Value of the horizontal axis.
    pub x: f64,
    /// Value of the vertical axis.
    pub y: f64,
    /// The sweep's outcome.
    pub sweep: Class,
    /// The reference's outcome.
    pub reference: Class,
}

/// How the sample came out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verification {
    /// Cells run again.
    pub sampled: usize,
    /// Those of them beside a boundary between outcomes.
    pub beside_boundary: usize,
    /// Cells of which the sweep says nothing.
    pub unresolved: usize,
    /// Cells whose outcome differs.
    pub differ: usize,
    /// The first of them.
    pub differences: Vec<Difference>,
    /// Overturned cells, agreeing about it, whose impact count differs.
    pub impacts_differ: usize,
    /// Largest error of the time of overturning where outcome and impacts agree, s.
    pub worst_t_end: f64,
    /// Largest error of the first uplift where the outcome agrees, s.
    pub worst_t_uplift: f64,
    /// Largest error of zeta where the outcome agrees.
    pub worst_zeta: f64,
    /// Median error of zeta over the cells that rock.
    pub median_zeta: f64,
}

/// Most differing cells that are listed.
const LISTED: usize = 16;

/// True where a neighbour has another outcome.
fn beside_boundary(grid: &Grid, outcomes: &[Outcome], index: usize) -> bool {
    let (columns, rows) = grid.shape();
    let (i, j) = (index % columns, index / columns);
    let differs = |other: usize| outcomes[other].class != outcomes[index].class;
    (i > 0 && differs(index - 1))
        || (i + 1 < columns && differs(index + 1))
        || (j > 0 && differs(index - columns))
        || (j + 1 < rows && differs(index + columns))
}

/// `count` elements spread evenly over a list.
fn spread(list: &[usize], count: usize) -> impl Iterator<Item = usize> + '_ {
    let count = count.min(list.len());
    (0..count).map(move |k| list[(2 * k + 1) * list.len() / (2 * count)])
}

/// The cells to run again: half beside a boundary, half elsewhere; one half fills up the other
/// where it has too few.
pub fn sample(grid: &Grid, outcomes: &[Outcome], size: usize) -> Vec<usize> {
    let (beside, elsewhere): (Vec<usize>, Vec<usize>) =
        (0..outcomes.len()).partition(|&index| beside_boundary(grid, outcomes, index));
    let from_beside = (size / 2).max(size.saturating_sub(elsewhere.len())).min(beside.len());
    let mut cells: Vec<usize> = spread(&beside, from_beside)
        .chain(spread(&elsewhere, size.saturating_sub(from_beside)))
        .collect();
    cells.sort_unstable();
    cells
}

/// Runs a sample of a sweep's cells again by the reference and compares.
pub fn verify(plan: &Plan, grid: &Grid, outcomes: &[Outcome], size: usize) -> Verification {
    let cells = sample(grid, outcomes, size);
    let parts = plan.parts(grid, 0..grid.len());
    let scene = |index: usize| {
        let part = parts.iter().find(|part| part.cells.binary_search(&index).is_ok());
        part.map_or(&plan.scene, |part| &part.plan.scene)
    };
    let settings = Settings::default();
    let judged: Vec<(usize, Outcome)> = cells
        .par_iter()
        .map(|&index| (index, reference::run(scene(index), &grid.point(index), &settings)))
        .collect();
    let mut report = compare(grid, &judged, |index| outcomes[index]);
    report.beside_boundary =
        cells.iter().filter(|&&index| beside_boundary(grid, outcomes, index)).count();
    report
}

/// Compares a sweep with the reference's outcomes of some of its cells.
pub fn compare(
    grid: &Grid,
    judged: &[(usize, Outcome)],
    sweep: impl Fn(usize) -> Outcome,
) -> Verification {
    let mut report = Verification {
        sampled: judged.len(),
        beside_boundary: 0,
        unresolved: 0,
        differ: 0,
        differences: Vec::new(),
        impacts_differ: 0,
        worst_t_end: 0.0,
        worst_t_uplift: 0.0,
        worst_zeta: 0.0,
        median_zeta: 0.0,
    };
    let mut zeta_errors = Vec::new();
    for (index, reference) in judged {
        let cell = sweep(*index);
        if cell.class == Class::Unresolved {
            report.unresolved += 1;
            continue;
        }
        if cell.class != reference.class {
            report.differ += 1;
            if report.differences.len() < LISTED {
                let (x, y) = grid.coordinates(*index);
                let (sweep, reference) = (cell.class, reference.class);
                report.differences.push(Difference { x, y, sweep, reference });
            }
            continue;
        }
        if let (Some(a), Some(b)) = (cell.t_uplift, reference.t_uplift) {
            report.worst_t_uplift = report.worst_t_uplift.max((a - b).abs());
        }
        if cell.class.overturned() {
            if cell.impacts == reference.impacts {
                report.worst_t_end = report.worst_t_end.max((cell.t_end - reference.t_end).abs());
            } else {
                report.impacts_differ += 1;
            }
        } else {
            let error = (cell.zeta - reference.zeta).abs();
            report.worst_zeta = report.worst_zeta.max(error);
            if cell.class == Class::Rocking {
                zeta_errors.push(error);
            }
        }
    }
    zeta_errors.sort_by(f64::total_cmp);
    report.median_zeta = zeta_errors.get(zeta_errors.len() / 2).copied().unwrap_or(0.0);
    report
}
