//! The tables of a study: fragility.csv, fits.csv, runs.csv, capacities.csv, sensitivity.csv, points.csv and rates.csv.

use super::capacity::Capacity;
use super::curve::Lognormal;
use super::estimate::{Estimate, Estimator};
use super::hazard::in_50_years;
use super::limit_state::LimitState;
use super::rates::RateEstimate;
use super::study::{CellStudy, FragilityStudy, StateStudy};
use crate::suites::swept_motion::SweptMotion;
use crate::table::{Columns, Field, Table, TableColumn, number};
use crate::uncertain::{Index, Varied};
use topple::Written;

/// What stands in a row beside its limit state.
type OfState<'a, T> = (&'a LimitState, T);
/// What stands in a row beside its limit state and its estimator.
type OfEstimate<'a> = OfState<'a, (&'a StateStudy, Estimator, &'a Estimate)>;

/// Every limit state of every cell, with the cell's number.
fn states(study: &FragilityStudy) -> impl Iterator<Item = (usize, OfState<'_, &StateStudy>)> {
    let of = |(number, cell)| {
        let cell: &CellStudy = cell;
        let states = study.settings.states.iter().zip(&cell.states);
        states.map(move |(state, of)| (number, (state, of)))
    };
    study.cells.iter().enumerate().flat_map(of)
}

/// Every estimate of every limit state of every cell.
fn estimates(study: &FragilityStudy) -> impl Iterator<Item = (usize, OfEstimate<'_>)> {
    states(study).flat_map(|(cell, (state, of))| {
        let named = study.settings.estimators.iter().zip(&of.estimates);
        named.map(move |(by, fit)| (cell, (state, (of, *by, fit))))
    })
}

/// The columns of rows that begin with a limit state.
fn of_state<'a, T>() -> Columns<OfState<'a, T>> {
    let of = "what the block is not to do";
    Columns::new().text("limit_state", of, |(state, _): &OfState<T>| state.to_string())
}

/// Those of rows that begin with a limit state and an estimator.
fn of_estimate<'a>() -> Columns<OfEstimate<'a>> {
    of_state().text("estimator", "how it is estimated", |(_, (_, by, _)): &OfEstimate| by.key())
}

/// Those of rows that begin with a motion.
fn of_record<'a, T>() -> Columns<(&'a str, T)> {
    Columns::new().text("record", "name of the motion", |(id, _): &(&str, T)| id.to_string())
}

const LEVEL: &str = "level of the intensity measure";
const THETA: &str = "median of the fragility";
const BETA: &str = "standard deviation of ln(level)";

/// fragility.csv: how many runs there are at each level, and how many of them exceed each limit state.
pub(super) fn counts(study: &FragilityStudy) -> Table<'_> {
    let unit = study.settings.im.unit();
    let columns = of_state::<&(f64, usize, usize)>()
        .number("level", unit, LEVEL, |(_, (level, ..))| *level)
        .number("records", "1", "runs at the level", |(_, (_, records, _))| *records)
        .number("failed", "1", "runs that exceed the limit state", |(_, (.., failed))| *failed);
    let rows = states(study).flat_map(|(cell, (state, of))| {
        of.counts.iter().map(move |counts| (cell, (state, counts)))
    });
    Table::of_cells(&study.sweep.grid, columns, rows)
}

/// fits.csv: theta and beta of each limit state by each estimator, with their intervals.
pub(super) fn fits(study: &FragilityStudy) -> Table<'_> {
    let unit = study.settings.im.unit();
    let low = |of: &str| format!("low end of the 95 % interval of {of}");
    let high = |of: &str| format!("high end of the 95 % interval of {of}");
    let separable = "1 where all runs stand up to a level and all fail above it";
    let columns = of_estimate()
        .number("theta", unit, THETA, |(_, (.., fit))| fit.theta)
        .number("theta_low", unit, low("theta"), |(_, (.., fit))| fit.theta_low)
        .number("theta_high", unit, high("theta"), |(_, (.., fit))| fit.theta_high)
        .number("beta", "1", BETA, |(_, (.., fit))| fit.beta)
        .number("beta_low", "1", low("beta"), |(_, (.., fit))| fit.beta_low)
        .number("beta_high", "1", high("beta"), |(_, (.., fit))| fit.beta_high)
        .number("separable", "1", separable, |(_, (.., fit))| fit.separable);
    Table::of_cells(&study.sweep.grid, columns, estimates(study))
}

/// runs.csv: every run, level by level, with its outcome, max |u|, the stroke of v and the rocking index.
pub(super) fn runs(study: &FragilityStudy) -> Table<'_> {
    // A motion with a level, and the place of the run at this level.
    let unit = study.settings.im.unit();
    let columns = of_record::<(&SweptMotion, f64, usize)>()
        .number("level", unit, LEVEL, |(_, (_, level, _))| *level)
        .text("outcome", "what became of the block", |(_, (of, _, at))| of.outcomes[*at].name())
        .number("max_u", "m", "max |u|", |(_, (of, _, at))| f64::from(of.max_u[*at]))
        .number("stroke_v", "m", "stroke of v", |(_, (of, _, at))| f64::from(of.stroke_v[*at]))
        .number("zeta", "1", "rocking index", |(_, (of, _, at))| f64::from(of.zeta[*at]));
    let cells = study.sweep.grid.len();
    let rows = (0..cells).flat_map(move |cell| {
        let motions = study.sweep.motions.iter().zip(&study.settings.levels);
        motions.flat_map(move |(of, levels)| {
            let at = move |(k, level): (usize, &f64)| (of, *level, k * cells + cell);
            levels.iter().enumerate().map(move |level| (cell, (&*of.id, at(level))))
        })
    });
    Table::of_cells(&study.sweep.grid, columns, rows)
}

/// capacities.csv: the lowest and the highest level at which each record overturns the block, and whether it stands at a level
/// above the lowest.
pub(super) fn capacities(study: &FragilityStudy) -> Table<'_> {
    let unit = study.settings.im.unit();
    let lowest = "lowest level at which the motion overturns the block";
    let again = "1 where the block stands at a level above the lowest";
    let columns = of_record::<Option<Capacity>>()
        .number("lowest", unit, lowest, |(_, of)| of.map(|of| of.lowest))
        .number("highest", unit, "highest level at which it does", |(_, of)| {
            of.map(|of| of.highest)
        })
        .number("stands_again", "1", again, |(_, of)| of.is_some_and(|of| of.stands_again));
    let rows = study.cells.iter().enumerate().flat_map(|(cell, of)| {
        let records = study.records().zip(of.capacities.iter().copied());
        records.map(move |row| (cell, row))
    });
    Table::of_cells(&study.sweep.grid, columns, rows)
}

/// sensitivity.csv: what each number that is not known explains of the share of all runs that fail.
pub(super) fn sensitivity(study: &FragilityStudy) -> Table<'_> {
    let (low, high) = ("low end of its 95 % interval", "high end of its 95 % interval");
    let columns = of_state::<(&Varied, &Index)>()
        .text("parameter", "number that is not known", |(_, (varied, _))| varied.parameter.key())
        .number("first", "1", "first-order Sobol index", |(_, (_, of))| of.first.numbers()[0])
        .number("first_low", "1", low, |(_, (_, of))| of.first.numbers()[1])
        .number("first_high", "1", high, |(_, (_, of))| of.first.numbers()[2])
        .number("total", "1", "total Sobol index", |(_, (_, of))| of.total.numbers()[0])
        .number("total_low", "1", low, |(_, (_, of))| of.total.numbers()[1])
        .number("total_high", "1", high, |(_, (_, of))| of.total.numbers()[2]);
    let varied = || study.settings.unknown.iter().flat_map(|unknown| &unknown.varied);
    let rows = states(study).flat_map(move |(cell, (state, of))| {
        let indices = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.indices);
        varied().zip(indices).map(move |of| (cell, (state, of)))
    });
    Table::of_cells(&study.sweep.grid, columns, rows)
}

/// points.csv: the points that are drawn of numbers that are not known, and theta and beta at each.
pub(super) fn points(study: &FragilityStudy) -> Table<'_> {
    /// A point with its curve.
    type Row<'a> = OfState<'a, (&'a Vec<f64>, &'a Option<Lognormal>)>;
    let unknown = || study.settings.unknown.iter();
    let drawn = unknown().flat_map(|unknown| &unknown.varied).enumerate().map(|(k, varied)| {
        let entry = varied.parameter.entry();
        let unit = if entry.unit.is_empty() { "1" } else { entry.unit };
        let meaning = format!("{}, as drawn", entry.meaning);
        number(format!("drawn_{}", entry.key), unit, meaning, move |(_, (at, _)): &Row| at[k])
    });
    let columns: Columns<Row> = of_state()
        .with(drawn)
        .number("theta", study.settings.im.unit(), THETA, |(_, (_, of))| of.map(|of| of.theta))
        .number("beta", "1", BETA, |(_, (_, of))| of.map(|of| of.beta));
    let rows = states(study).flat_map(move |(cell, (state, of))| {
        let curves = of.sensitivity.iter().flat_map(|sensitivity| &sensitivity.curves);
        let points = unknown().flat_map(|unknown| unknown.design.rows());
        points.zip(curves).map(move |of| (cell, (state, of)))
    });
    Table::of_cells(&study.sweep.grid, columns, rows)
}

/// rates.csv: the annual rate of each limit state over the study's hazard curve, and its probability in 50 years.
pub(super) fn rates(study: &FragilityStudy) -> Table<'_> {
    fn rate<'a, V: Into<Field>>(
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        value: impl Fn(&RateEstimate) -> Option<V> + 'static,
    ) -> TableColumn<OfEstimate<'a>> {
        number(name, unit, meaning, move |(_, (.., fit)): &OfEstimate| value(fit.rate.as_ref()?))
    }
    let target = study.settings.target;
    let rates = "annual rate at which motions between the first and the last level of the hazard curve exceed the limit state";
    let above = "rate of motions above the last level of the hazard curve";
    let keeps = "1 where the rate is not above the target, missing_above and missing_below added";
    let below = "largest rate of failures below the first level, the hazard curve no steeper there than between its first two";
    let high = "high end of the 95 % interval of the rate; without a rate, where all motions above the last level without a failure fail";
    let empirical = "rate by the shares of the motions alone, without a curve";
    let without =
        "share of the rate that comes from levels below the lowest at which a motion fails";
    let highest = "share of the rate that comes from above the highest level";
    let ordered =
        "rate of the curve held below the curves of the limit states that this one implies";
    let columns = of_estimate()
        .with([
            rate("rate", "1/year", rates, |rate| rate.rate),
            rate("in_50_years", "1", "probability that they exceed it in 50 years", |rate| {
                rate.rate.map(in_50_years)
            }),
            rate("missing_above", "1/year", above, |rate| Some(rate.missing_above)),
            rate("below_target", "1", keeps, move |rate| rate.is_below(target?)),
            rate("missing_below", "1/year", below, |rate| Some(rate.missing_below)),
            rate("rate_low", "1/year", "low end of the 95 % interval of the rate", |rate| rate.low),
            rate("rate_high", "1/year", high, |rate| rate.high),
        ])
        .number("rate_empirical", "1/year", empirical, |(_, (of, ..))| of.empirical)
        .with([
            rate("share_without_failures", "1", without, |rate| rate.without_failures),
            rate("share_above_levels", "1", highest, |rate| rate.above_levels),
            rate("rate_ordered", "1/year", ordered, |rate| rate.ordered),
        ]);
    Table::of_cells(&study.sweep.grid, columns, estimates(study))
}
