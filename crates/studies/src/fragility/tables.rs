//! The tables of a study: fragility.csv, fits.csv, capacities.csv and rates.csv.

use std::io::{self, Write};

use super::estimate::Estimate;
use super::hazard::in_50_years;
use super::limit_state::LimitState;
use super::rates::RateEstimate;
use super::study::{CellStudy, FragilityStudy, StateStudy};
use super::table_columns::{CAPACITIES, COUNTS, FITS, POINTS, RATES, RUNS, SENSITIVITY};
use crate::suites::columns;
use crate::suites::grid_table::GridTable;
use topple::Written;
use topple::results::csv::Number;

/// A number that may be missing.
fn known(value: Option<f64>) -> Option<Number> {
    value.filter(|value| value.is_finite()).map(Number)
}

/// Every limit state of every cell, with the cell's number.
fn states(study: &FragilityStudy) -> impl Iterator<Item = (usize, &LimitState, &StateStudy)> {
    let of = |(number, cell)| {
        let cell: &CellStudy = cell;
        study.settings.states.iter().zip(&cell.states).map(move |(state, of)| (number, state, of))
    };
    study.cells.iter().enumerate().flat_map(of)
}

/// Every estimate of every limit state of every cell.
fn estimates(
    study: &FragilityStudy,
) -> impl Iterator<Item = (usize, &LimitState, &'static str, &Estimate)> {
    let of = |(cell, state, of)| {
        let of: &StateStudy = of;
        let named = study.settings.estimators.iter().zip(&of.estimates);
        named.map(move |(estimator, fit)| (cell, state, estimator.key(), fit))
    };
    states(study).flat_map(of)
}

/// Writes fragility.csv: how many runs there are at each level, and how many of them exceed each limit state.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_counts(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&COUNTS))?;
    for (cell, state, of) in states(study) {
        for (level, records, failed) in &of.counts {
            table.row(cell, (state, Number(*level), records, failed))?;
        }
    }
    table.end()
}

/// Writes fits.csv: theta and beta of each limit state by each estimator, with their intervals.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_fits(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&FITS))?;
    for (cell, state, name, fit) in estimates(study) {
        let theta = [fit.theta, fit.theta_low, fit.theta_high].map(known);
        let beta = [fit.beta, fit.beta_low, fit.beta_high].map(known);
        table.row(cell, (state, name, theta, beta, u8::from(fit.separable)))?;
    }
    table.end()
}

/// Writes runs.csv: every run, level by level, with its outcome, max |u|, the stroke of v and the rocking index.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_runs(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&RUNS))?;
    let cells = study.sweep.grid.len();
    for cell in 0..cells {
        for (motion, levels) in study.sweep.motions.iter().zip(&study.settings.levels) {
            for (k, level) in levels.iter().enumerate() {
                let index = k * cells + cell;
                let numbers = [&motion.max_u, &motion.stroke_v, &motion.zeta];
                let numbers = numbers.map(|values| Number(f64::from(values[index])));
                let outcome = motion.outcomes[index].name();
                table.row(cell, (&motion.id, Number(*level), outcome, numbers))?;
            }
        }
    }
    table.end()
}

/// Writes capacities.csv: the lowest and the highest level at which each record overturns the block, and whether it
/// stands at a level above the lowest.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_capacities(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&CAPACITIES))?;
    for (number, cell) in study.cells.iter().enumerate() {
        for (record, capacity) in study.records().zip(&cell.capacities) {
            let lowest = known(capacity.map(|capacity| capacity.lowest));
            let highest = known(capacity.map(|capacity| capacity.highest));
            let again = u8::from(capacity.is_some_and(|capacity| capacity.stands_again));
            table.row(number, (record, lowest, highest, again))?;
        }
    }
    table.end()
}

/// Writes sensitivity.csv: what each number that is not known explains of the share of all runs that fail.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_sensitivity(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let Some(unknown) = &study.settings.unknown else { return Ok(()) };
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&SENSITIVITY))?;
    for (cell, state, of) in states(study) {
        let indices = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.indices);
        for (varied, one) in unknown.varied.iter().zip(indices) {
            let [first, total] = [one.first, one.total].map(|of| of.numbers().map(known));
            table.row(cell, (state, varied.parameter.key(), first, total))?;
        }
    }
    table.end()
}

/// Writes points.csv: the points that are drawn of numbers that are not known, and theta and beta at each.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_points(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let Some(unknown) = &study.settings.unknown else { return Ok(()) };
    let drawn = unknown.varied.iter().map(|varied| format!("drawn_{}", varied.parameter.key()));
    let drawn: Vec<String> = drawn.collect();
    let [state, curve @ ..] = POINTS.map(|column| column.name);
    let names = [state].into_iter().chain(drawn.iter().map(String::as_str)).chain(curve);
    let mut table = GridTable::begin(&study.sweep.grid, writer, names)?;
    for (cell, state, of) in states(study) {
        let curves = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.curves);
        for (point, curve) in unknown.design.rows().zip(curves) {
            let point: Vec<Number> = point.iter().copied().map(Number).collect();
            let theta = known(curve.map(|curve| curve.theta));
            let beta = known(curve.map(|curve| curve.beta));
            table.row(cell, (state, point, theta, beta))?;
        }
    }
    table.end()
}

/// Writes rates.csv: the annual rate of each limit state over the study's hazard curve, and its probability in 50 years.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_rates(study: &FragilityStudy, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = GridTable::begin(&study.sweep.grid, writer, columns::names(&RATES))?;
    for (cell, state, of) in states(study) {
        for (estimator, fit) in study.settings.estimators.iter().zip(&of.estimates) {
            let rate = fit.rate.as_ref();
            let by = |part: fn(&RateEstimate) -> Option<f64>| known(rate.and_then(part));
            let numbers = [
                by(|rate| rate.rate),
                by(|rate| rate.rate.map(in_50_years)),
                by(|rate| Some(rate.missing_above)),
            ];
            let below =
                rate.zip(study.settings.target).and_then(|(rate, target)| rate.is_below(target));
            let data = [
                by(|rate| Some(rate.missing_below)),
                by(|rate| rate.low),
                by(|rate| rate.high),
                known(of.empirical),
                by(|rate| rate.without_failures),
                by(|rate| rate.above_levels),
                by(|rate| rate.ordered),
            ];
            table.row(cell, (state, estimator.key(), numbers, below.map(u8::from), data))?;
        }
    }
    table.end()
}
