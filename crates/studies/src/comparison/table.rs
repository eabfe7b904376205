//! compare.csv: one row per device.

use std::io::{self, Write};

use super::compared::{Compared, Comparison};
use crate::suites::columns::{self, TableColumn, known, name, number};
use topple::results::csv::Number;

/// The columns that are always there.
pub const COLUMNS: [TableColumn; 14] = [
    name("device", "name of the device"),
    number("records", "1", "motions"),
    number("standing", "1", "share of the motions under which the block stands"),
    number(
        "lifted",
        "1",
        "share of the motions under which it lifts, whether it stands or overturns",
    ),
    number("max_u_50", "m", "median of max |u| over the motions under which it stands"),
    number("max_u_84", "m", "84th percentile of max |u| over the motions under which it stands"),
    number("max_u_100", "m", "largest max |u| over the motions under which it stands"),
    number("stroke_v_50", "m", "median of the stroke of v over the motions under which it stands"),
    number(
        "stroke_v_84",
        "m",
        "84th percentile of the stroke of v over the motions under which it stands",
    ),
    number("stroke_v_100", "m", "largest stroke of v over the motions under which it stands"),
    number("overturned", "1", "share of the motions under which it overturns"),
    number("overturned_low", "1", "lower end of the interval of 95 % of overturned"),
    number("overturned_high", "1", "upper end of the interval of 95 % of overturned"),
    number("feasible", "1", "1 where all limits are kept"),
];

/// Those of the reserve.
pub const RESERVE: [TableColumn; 2] = [
    number(
        "reserve",
        "1",
        "largest of the factors of the list and 1 up to which all limits are kept; 0 where they are not at the least",
    ),
    number(
        "fails_at",
        "1",
        "least of these factors at which a limit is not kept, so that the reserve ends between both; empty where none is",
    ),
];

/// Those of annual rates.
pub const RATES: [TableColumn; 5] = [
    number(
        "rate",
        "1/year",
        "annual rate of overturning; empty where neither a curve nor a step is known",
    ),
    number("rate_low", "1/year", "lower end of its interval of 95 %"),
    number("rate_high", "1/year", "upper end of its interval of 95 %"),
    number(
        "rate_with_missing",
        "1/year",
        "the rate with what may be missing at both ends of the hazard curve: of the best estimate, whose interval may reach farther, or without a curve the upper bound; empty where there is none",
    ),
    number(
        "rate_ordered",
        "1/year",
        "the rate of the curve held below that of uplift, which overturning implies",
    ),
];

/// Writes compare.csv.
///
/// # Errors
/// Those of the writer.
pub(super) fn write(comparison: &Comparison, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(writer);
    let settings = &comparison.settings;
    let (reserves, rates) = (!settings.scales.is_empty(), settings.hazard.is_some());
    let of_reserve: &[TableColumn] = if reserves { &RESERVE } else { &[] };
    let of_rate: &[TableColumn] = if rates { &RATES } else { &[] };
    let own = [&COLUMNS, of_reserve, of_rate].concat();
    let further = columns::further_names(&settings.columns);
    table.write_record(columns::names(&own).map(String::from).chain(further))?;
    let records = comparison.records();
    for (name, Compared { cell, lifted, columns, reserve, rate, .. }) in comparison.rows() {
        let (u, v) = (cell.max_u.map(known), cell.stroke_v.map(known));
        let within = cell.overturned_within.map(|end| end.map(Number));
        let feasible = u8::from(cell.feasible);
        let shares = [cell.standing, *lifted].map(Number);
        let of_reserve = reserves.then(|| {
            let keeps = reserve.map(|reserve| reserve.keeps.unwrap_or(0.0));
            [keeps, reserve.and_then(|reserve| reserve.fails)].map(|factor| factor.map(Number))
        });
        let of_rate = rates.then(|| {
            let rate = rate.as_ref().and_then(|rated| rated.estimate.rate.as_ref());
            [
                rate.and_then(|rate| rate.rate),
                rate.and_then(|rate| rate.low),
                rate.and_then(|rate| rate.high),
                rate.and_then(|rate| rate.with_missing()),
                rate.and_then(|rate| rate.ordered),
            ]
            .map(|value| value.map(Number))
        });
        let own = (name, records, shares, u, v, Number(cell.overturned), within, feasible);
        let of_columns: Vec<_> = columns.iter().flatten().copied().map(known).collect();
        // A part that nobody asks for is no field, an empty one is.
        let of_reserve: Vec<_> = of_reserve.into_iter().flatten().collect();
        let of_rate: Vec<_> = of_rate.into_iter().flatten().collect();
        table.serialize((own, of_reserve, of_rate, of_columns))?;
    }
    table.flush()
}
