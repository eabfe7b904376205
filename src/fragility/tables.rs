//! The tables of a study: fragility.csv, fits.csv, capacities.csv and rates.csv.

use std::io::Write;

use super::estimate::Estimate;
use super::fit::Lognormal;
use super::hazard::{AnnualRate, HazardCurve, in_50_years};
use super::study::Study;
use crate::results::csv::Number;
use crate::suites::columns;

/// A number that may be missing.
fn known(value: Option<f64>) -> Option<Number> {
    value.filter(|value| value.is_finite()).map(Number)
}

/// Writes fragility.csv: how many runs there are at each level, and how many of them exceed each limit state.
///
/// # Errors
/// Those of the writer.
pub fn write_counts(study: &Study, writer: impl Write) -> csv::Result<()> {
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns::keys(grid).chain(["limit_state", "level", "records", "failed"]))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (state, of) in study.asked.states.iter().zip(&cell.states) {
            for (level, records, failed) in &of.counts {
                table.serialize((
                    columns::values(grid, index),
                    state,
                    Number(*level),
                    records,
                    failed,
                ))?;
            }
        }
    }
    Ok(table.flush()?)
}

/// Writes fits.csv: theta and beta of each limit state by each estimator, with their intervals.
///
/// # Errors
/// Those of the writer.
pub fn write_fits(study: &Study, writer: impl Write) -> csv::Result<()> {
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let names = [
        "limit_state",
        "estimator",
        "theta",
        "theta_low",
        "theta_high",
        "beta",
        "beta_low",
        "beta_high",
        "separable",
    ];
    table.write_record(columns::keys(grid).chain(names))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (state, of) in study.asked.states.iter().zip(&cell.states) {
            for (estimator, fit) in study.asked.estimators.iter().zip(&of.estimates) {
                let theta = [fit.theta, fit.theta_low, fit.theta_high].map(known);
                let beta = [fit.beta, fit.beta_low, fit.beta_high].map(known);
                let separable = u8::from(fit.separable);
                let name = estimator.name();
                table.serialize((
                    columns::values(grid, index),
                    state,
                    name,
                    theta,
                    beta,
                    separable,
                ))?;
            }
        }
    }
    Ok(table.flush()?)
}

/// Writes runs.csv: every run, level by level, with its outcome, max |u|, the stroke of v and the rocking index.
///
/// # Errors
/// Those of the writer.
pub fn write_runs(study: &Study, writer: impl Write) -> csv::Result<()> {
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let names = ["record", "level", "outcome", "max_u", "stroke_v", "zeta"];
    table.write_record(columns::keys(grid).chain(names))?;
    for cell in 0..grid.len() {
        for (motion, levels) in study.sweep.motions.iter().zip(&study.asked.levels) {
            for (k, level) in levels.iter().enumerate() {
                let index = k * grid.len() + cell;
                let numbers = [&motion.max_u, &motion.stroke_v, &motion.zeta];
                let numbers = numbers.map(|values| Number(f64::from(values[index])));
                let outcome = motion.outcomes[index].name();
                table.serialize((
                    columns::values(grid, cell),
                    &motion.id,
                    Number(*level),
                    outcome,
                    numbers,
                ))?;
            }
        }
    }
    Ok(table.flush()?)
}

/// Writes capacities.csv: the lowest and the highest level at which each record overturns the block, and whether it
/// stands at one between.
///
/// # Errors
/// Those of the writer.
pub fn write_capacities(study: &Study, writer: impl Write) -> csv::Result<()> {
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns::keys(grid).chain([
        "record",
        "lowest",
        "highest",
        "stands_again",
    ]))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (record, capacity) in study.records().zip(&cell.capacities) {
            let lowest = known(capacity.map(|capacity| capacity.lowest));
            let highest = known(capacity.map(|capacity| capacity.highest));
            let again = u8::from(capacity.is_some_and(|capacity| capacity.stands_again));
            table.serialize((columns::values(grid, index), record, lowest, highest, again))?;
        }
    }
    Ok(table.flush()?)
}

/// Writes sensitivity.csv: what each number that is not known explains of the share of all runs that fail.
///
/// # Errors
/// Those of the writer.
pub fn write_sensitivity(study: &Study, writer: impl Write) -> csv::Result<()> {
    let Some(unknown) = &study.asked.unknown else { return Ok(()) };
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let names = [
        "limit_state",
        "parameter",
        "first",
        "first_low",
        "first_high",
        "total",
        "total_low",
        "total_high",
    ];
    table.write_record(columns::keys(grid).chain(names))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (state, of) in study.asked.states.iter().zip(&cell.states) {
            let indices = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.indices);
            for (varied, one) in unknown.varied.iter().zip(indices) {
                let first = [one.first, one.first_low, one.first_high].map(Some).map(known);
                let total = [one.total, one.total_low, one.total_high].map(Some).map(known);
                table.serialize((
                    columns::values(grid, index),
                    state,
                    varied.parameter.key(),
                    first,
                    total,
                ))?;
            }
        }
    }
    Ok(table.flush()?)
}

/// Writes points.csv: the points that are drawn of numbers that are not known, and theta and beta at each.
///
/// # Errors
/// Those of the writer.
pub fn write_points(study: &Study, writer: impl Write) -> csv::Result<()> {
    let Some(unknown) = &study.asked.unknown else { return Ok(()) };
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let keys = unknown.varied.iter().map(|varied| format!("drawn_{}", varied.parameter.key()));
    let names = columns::keys(grid).map(String::from).chain(["limit_state".into()]).chain(keys);
    table.write_record(names.chain(["theta".into(), "beta".into()]))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (state, of) in study.asked.states.iter().zip(&cell.states) {
            let curves = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.curves);
            for (point, curve) in unknown.design.rows().zip(curves) {
                let point: Vec<Number> = point.iter().copied().map(Number).collect();
                let theta = known(curve.map(|curve| curve.theta));
                let beta = known(curve.map(|curve| curve.beta));
                table.serialize((columns::values(grid, index), state, point, theta, beta))?;
            }
        }
    }
    Ok(table.flush()?)
}

/// The annual rate at which a limit state is exceeded; none where its fragility is not known.
pub fn rate(fit: &Estimate, hazard: &HazardCurve) -> Option<AnnualRate> {
    // Of separable data the step in the middle of the gap is taken.
    let beta = fit.beta.or(fit.separable.then_some(0.0))?;
    Some(hazard.rate(&Lognormal { theta: fit.theta?, beta }))
}

/// True where a rate is below a target, motions above the curve's last level counted as if all of them failed.
pub fn is_below(rate: &AnnualRate, target: f64) -> bool {
    rate.rate + rate.missing_above <= target
}

/// Writes rates.csv: the annual rate of each limit state over a hazard curve, and its probability in 50 years.
///
/// # Errors
/// Those of the writer.
pub fn write_rates(
    study: &Study,
    hazard: &HazardCurve,
    target: Option<f64>,
    writer: impl Write,
) -> csv::Result<()> {
    let grid = &study.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    let names =
        ["limit_state", "estimator", "rate", "in_50_years", "missing_above", "below_target"];
    table.write_record(columns::keys(grid).chain(names))?;
    for (index, cell) in study.cells.iter().enumerate() {
        for (state, of) in study.asked.states.iter().zip(&cell.states) {
            for (estimator, fit) in study.asked.estimators.iter().zip(&of.estimates) {
                let rate = rate(fit, hazard);
                let numbers = [
                    rate.map(|rate| rate.rate),
                    rate.map(|rate| in_50_years(rate.rate)),
                    rate.map(|rate| rate.missing_above),
                ];
                let below =
                    rate.zip(target).map(|(rate, target)| u8::from(is_below(&rate, target)));
                let row = (
                    columns::values(grid, index),
                    state,
                    estimator.name(),
                    numbers.map(known),
                    below,
                );
                table.serialize(row)?;
            }
        }
    }
    Ok(table.flush()?)
}
