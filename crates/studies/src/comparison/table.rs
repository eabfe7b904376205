//! compare.csv: one row per device.

use super::compared::{Compared, Comparison};
use crate::fragility::RateEstimate;
use crate::suites::columns::{further, of_standing};
use crate::table::{Columns, Table, TableColumn, number};

/// A device, and what became of it.
type Row<'a> = (&'a str, &'a Compared);

/// compare.csv. What nobody asks for is no column.
pub(super) fn compared(comparison: &Comparison) -> Table<'_> {
    let (settings, records) = (&comparison.settings, comparison.records());
    let standing = "share of the motions under which the block stands";
    let lifted = "share of the motions under which it lifts, whether it stands or overturns";
    let overturned = "share of the motions under which it overturns";
    let [low, high] =
        ["lower", "upper"].map(|end| format!("{end} end of the interval of 95 % of overturned"));
    let columns = Columns::<Row>::new()
        .text("device", "name of the device", |(name, _)| name.to_string())
        .number("records", "1", "motions", move |_| records)
        .number("standing", "1", standing, |(_, of)| of.cell.standing)
        .number("lifted", "1", lifted, |(_, of)| of.lifted)
        .with(of_standing(("max_u", "m"), ("", "max |u|"), |(_, of): &Row| of.cell.max_u))
        .with(of_standing(("stroke_v", "m"), ("the ", "stroke of v"), |(_, of): &Row| {
            of.cell.stroke_v
        }))
        .number("overturned", "1", overturned, |(_, of)| of.cell.overturned)
        .number("overturned_low", "1", low, |(_, of)| of.cell.overturned_within[0])
        .number("overturned_high", "1", high, |(_, of)| of.cell.overturned_within[1])
        .number("feasible", "1", "1 where all limits are kept", |(_, of)| of.cell.feasible)
        .with(of_reserve().into_iter().filter(|_| !settings.scales.is_empty()))
        .with(of_rate().into_iter().filter(|_| settings.hazard.is_some()))
        .with(further(&settings.columns, |(_, of): &Row, k| of.columns[k]));
    Table::of_rows(columns, comparison.rows().enumerate())
}

/// The columns of the reserve.
fn of_reserve<'a>() -> [TableColumn<Row<'a>>; 2] {
    let keeps = "largest of the factors of the list and 1 up to which all limits are kept; 0 where they are not at the least";
    let fails = "least of these factors at which a limit is not kept, so that the reserve ends between both; empty where none is";
    [
        number("reserve", "1", keeps, |(_, of): &Row| {
            of.reserve.map(|reserve| reserve.keeps.unwrap_or(0.0))
        }),
        number("fails_at", "1", fails, |(_, of): &Row| {
            of.reserve.and_then(|reserve| reserve.fails)
        }),
    ]
}

/// The columns of annual rates.
fn of_rate<'a>() -> [TableColumn<Row<'a>>; 5] {
    fn rate<'a>(
        name: &'static str,
        meaning: &'static str,
        value: fn(&RateEstimate) -> Option<f64>,
    ) -> TableColumn<Row<'a>> {
        number(name, "1/year", meaning, move |(_, of): &Row| {
            value(of.rate.as_ref()?.estimate.rate.as_ref()?)
        })
    }
    let known = "annual rate of overturning; empty where neither a curve nor a step is known";
    let missing = "the rate with what may be missing at both ends of the hazard curve: of the best estimate, whose interval may \
                   reach farther, or without a curve the upper bound; empty where there is none";
    let ordered = "the rate of the curve held below that of uplift, which overturning implies";
    [
        rate("rate", known, |rate| rate.rate),
        rate("rate_low", "lower end of its interval of 95 %", |rate| rate.low),
        rate("rate_high", "upper end of its interval of 95 %", |rate| rate.high),
        rate("rate_with_missing", missing, RateEstimate::with_missing),
        rate("rate_ordered", ordered, |rate| rate.ordered),
    ]
}
