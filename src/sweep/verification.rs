//! A sample of a sweep's cells, run again by the reference.

use std::io;

use rayon::prelude::*;
use serde::Serialize;

use crate::results::columns::Column;
use crate::results::outcomes::{BLOCK, Outcomes};
use crate::scene::Grid;
use crate::scene::grid::Axis;
use crate::stepping::outcome::{Class, Outcome};
use crate::stepping::reference::{self, Settings};

use super::plan::Plan;
use super::progress::{Progress, Unwatched};

/// Cells that are run again by default.
pub const SAMPLE: usize = 128;

/// A cell on which sweep and reference disagree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// Values of the axes.
    pub at: Vec<f64>,
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

/// Goes through all cells and tells of each whether a neighbour has another outcome; a few rows are
/// in memory at a time.
fn beside_boundary(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    mut tell: impl FnMut(usize, bool),
) -> io::Result<()> {
    let (columns, rows) = grid.shape();
    let height_of_slice = grid.y().map_or(1, Axis::count);
    let height = (BLOCK / columns).max(1);
    for first in (0..rows).step_by(height) {
        let last = (first + height).min(rows);
        let (below, above) = (first.saturating_sub(1), (last + 1).min(rows));
        let read = outcomes.read(below * columns..above * columns, &[Column::Outcome])?;
        for j in first..last {
            for i in 0..columns {
                let cell = (j - below) * columns + i;
                let differs = |other: usize| read[other].class != read[cell].class;
                // Of further axes the picture shows a slice each.
                let row = j % height_of_slice;
                let beside = (i > 0 && differs(cell - 1))
                    || (i + 1 < columns && differs(cell + 1))
                    || (row > 0 && differs(cell - columns))
                    || (row + 1 < height_of_slice && differs(cell + columns));
                tell(j * columns + i, beside);
            }
        }
    }
    Ok(())
}

/// The places of `count` elements spread evenly over a list of a length.
fn spread(length: usize, count: usize) -> impl Iterator<Item = usize> {
    let count = count.min(length);
    (0..count).map(move |k| (2 * k + 1) * length / (2 * count))
}

/// The cells to run again, in order, and how many of them lie beside a boundary: half do, half
/// do not; one half fills up the other where it has too few.
///
/// # Errors
/// Those of reading the outcomes.
pub fn sample(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    size: usize,
) -> io::Result<(Vec<usize>, usize)> {
    let mut beside = 0;
    beside_boundary(grid, outcomes, |_, is_beside| beside += usize::from(is_beside))?;
    let elsewhere = grid.len() - beside;
    let from_beside = (size / 2).max(size.saturating_sub(elsewhere)).min(beside);
    let mut chosen = [
        spread(elsewhere, size.saturating_sub(from_beside)).peekable(),
        spread(beside, from_beside).peekable(),
    ];
    let (mut cells, mut seen) = (Vec::with_capacity(size), [0; 2]);
    beside_boundary(grid, outcomes, |cell, is_beside| {
        let kind = usize::from(is_beside);
        if chosen[kind].next_if_eq(&seen[kind]).is_some() {
            cells.push(cell);
        }
        seen[kind] += 1;
    })?;
    Ok((cells, from_beside))
}

/// Runs a sample of a sweep's cells again by the reference and compares.
///
/// # Errors
/// Those of reading the outcomes.
pub fn verify(
    plan: &Plan,
    grid: &Grid,
    outcomes: &dyn Outcomes,
    size: usize,
) -> io::Result<Verification> {
    let sample = sample(grid, outcomes, size)?;
    let verified = verify_sample(plan, grid, outcomes, sample, &Unwatched)?;
    verified.ok_or_else(|| io::ErrorKind::Interrupted.into())
}

/// The same of a [`sample`] at hand, while `progress` hears of cells; none where it is cancelled.
///
/// # Errors
/// Those of reading the outcomes.
pub fn verify_sample(
    plan: &Plan,
    grid: &Grid,
    outcomes: &dyn Outcomes,
    (cells, beside_boundary): (Vec<usize>, usize),
    progress: &dyn Progress,
) -> io::Result<Option<Verification>> {
    let settings = Settings::default();
    let judge = |&index: &usize| {
        let mut case = grid.case(index);
        if plan.locks_vertical(&case) {
            case.isolation.vertical = None;
        }
        let cell = outcomes.read(index..index + 1, &Column::ALL)?[0];
        let go_on = || !progress.cancelled();
        let reference = reference::run_while(&plan.scene, &case, &settings, &go_on);
        progress.advance(1);
        Ok(reference.map(|reference| (index, cell, reference)))
    };
    let judged: Option<Vec<(usize, Outcome, Outcome)>> =
        cells.par_iter().map(judge).collect::<io::Result<_>>()?;
    Ok(judged.map(|judged| Verification { beside_boundary, ..compare(grid, judged) }))
}

/// Compares a sweep's outcomes of some cells with the reference's, which come second.
pub fn compare(
    grid: &Grid,
    judged: impl IntoIterator<Item = (usize, Outcome, Outcome)>,
) -> Verification {
    let mut report = Verification {
        sampled: 0,
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
    for (index, cell, reference) in judged {
        report.sampled += 1;
        if cell.class == Class::Unresolved {
            report.unresolved += 1;
            continue;
        }
        if cell.class != reference.class {
            report.differ += 1;
            if report.differences.len() < LISTED {
                let at = grid.coordinates(index).collect();
                let (sweep, reference) = (cell.class, reference.class);
                report.differences.push(Difference { at, sweep, reference });
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
