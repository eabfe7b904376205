//! The columns of a study's tables, after the axes.

use crate::suites::columns::{TableColumn, measure, name, number};

const STATE: TableColumn = name("limit_state", "what the block is not to do");
const ESTIMATOR: TableColumn = name("estimator", "how it is estimated");
const RECORD: TableColumn = name("record", "name of the motion");
const LEVEL: TableColumn = measure("level", "level of the intensity measure");
const THETA: TableColumn = measure("theta", "median of the fragility");
const BETA: TableColumn = number("beta", "1", "standard deviation of ln(level)");

/// Those of fragility.csv.
pub const COUNTS: [TableColumn; 4] = [
    STATE,
    LEVEL,
    number("records", "1", "runs at the level"),
    number("failed", "1", "runs that exceed the limit state"),
];

/// Those of fits.csv.
pub const FITS: [TableColumn; 9] = [
    STATE,
    ESTIMATOR,
    THETA,
    measure("theta_low", "low end of the 95 % interval of theta"),
    measure("theta_high", "high end of the 95 % interval of theta"),
    BETA,
    number("beta_low", "1", "low end of the 95 % interval of beta"),
    number("beta_high", "1", "high end of the 95 % interval of beta"),
    number("separable", "1", "1 where all runs stand up to a level and all fail above it"),
];

/// Those of runs.csv.
pub const RUNS: [TableColumn; 6] = [
    RECORD,
    LEVEL,
    name("outcome", "what became of the block"),
    number("max_u", "m", "max |u|"),
    number("stroke_v", "m", "stroke of v"),
    number("zeta", "1", "rocking index"),
];

/// Those of capacities.csv.
pub const CAPACITIES: [TableColumn; 4] = [
    RECORD,
    measure("lowest", "lowest level at which the motion overturns the block"),
    measure("highest", "highest level at which it does"),
    number("stands_again", "1", "1 where the block stands at a level above the lowest"),
];

/// Those of sensitivity.csv.
pub const SENSITIVITY: [TableColumn; 8] = [
    STATE,
    name("parameter", "number that is not known"),
    number("first", "1", "first-order Sobol index"),
    number("first_low", "1", "low end of its 95 % interval"),
    number("first_high", "1", "high end of its 95 % interval"),
    number("total", "1", "total Sobol index"),
    number("total_low", "1", "low end of its 95 % interval"),
    number("total_high", "1", "high end of its 95 % interval"),
];

/// Those of points.csv; the numbers that are drawn stand after the limit state.
pub const POINTS: [TableColumn; 3] = [STATE, THETA, BETA];

/// Those of rates.csv.
pub const RATES: [TableColumn; 13] = [
    STATE,
    ESTIMATOR,
    number(
        "rate",
        "1/year",
        "annual rate at which motions between the first and the last level of the hazard curve exceed the limit state",
    ),
    number("in_50_years", "1", "probability that they exceed it in 50 years"),
    number("missing_above", "1/year", "rate of motions above the last level of the hazard curve"),
    number(
        "below_target",
        "1",
        "1 where the rate is not above the target, missing_above and missing_below added",
    ),
    number(
        "missing_below",
        "1/year",
        "largest rate of failures below the first level, the hazard curve no steeper there than between its first two",
    ),
    number("rate_low", "1/year", "low end of the 95 % interval of the rate"),
    number(
        "rate_high",
        "1/year",
        "high end of the 95 % interval of the rate; without a rate, where all motions above the last level without a failure fail",
    ),
    number("rate_empirical", "1/year", "rate by the shares of the motions alone, without a curve"),
    number(
        "share_without_failures",
        "1",
        "share of the rate that comes from levels below the lowest at which a motion fails",
    ),
    number("share_above_levels", "1", "share of the rate that comes from above the highest level"),
    number(
        "rate_ordered",
        "1/year",
        "rate of the curve held below the curves of the limit states that this one implies",
    ),
];
