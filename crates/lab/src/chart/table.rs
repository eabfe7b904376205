//! chart.csv: one row per trial.

use std::io::{Read, Write};

use serde::{Deserialize, Serialize, Serializer};

use super::errors::{Errors, Spread};

/// A row: what was tried, what it took, how far it was off.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Short name of the bench.
    pub bench: &'static str,
    /// Name of the method; of another program, with its version.
    pub method: String,
    /// f32 or f64.
    pub precision: &'static str,
    /// True for a step, false for a tolerance.
    pub steps: bool,
    /// Step, s, or relative tolerance.
    pub setting: f64,
    /// Threads of the host that took part.
    pub threads: usize,
    /// The whole time, s a cell.
    pub seconds: f64,
    /// The time in the shader, s a cell.
    pub device: Option<f64>,
    /// Compilation, s.
    pub start: f64,
    /// Number of runs, of which the quickest counts.
    pub runs: u32,
    /// The errors.
    pub errors: Errors,
}

impl Row {
    /// Share of cells with another outcome than the truth's, failed ones among them.
    pub fn wrong(&self) -> f64 {
        (self.errors.differ + self.errors.failed) as f64 / self.errors.cells.max(1) as f64
    }

    /// Share of cells whose first switches are not the truth's.
    pub fn other_sequence(&self) -> Option<f64> {
        let agree = self.errors.sequences?;
        Some(1.0 - agree as f64 / self.errors.cells.max(1) as f64)
    }
}

/// A number that is written with an exponent.
#[derive(Clone, Copy, Deserialize)]
struct Exponent(f64);

impl Serialize for Exponent {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(&format_args!("{:e}", self.0))
    }
}

/// Writes a time to a millisecond.
fn to_milliseconds<S: Serializer>(time: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(&format_args!("{time:.3}"))
}

/// A row as written, by the names of the columns. A number that there is none of is left empty.
#[derive(Serialize, Deserialize)]
struct Written {
    scene: String,
    method: String,
    precision: String,
    step: Option<Exponent>,
    tolerance: Option<Exponent>,
    threads: usize,
    seconds_a_cell: Exponent,
    device_seconds_a_cell: Option<Exponent>,
    #[serde(serialize_with = "to_milliseconds")]
    start_seconds: f64,
    runs: u32,
    cells: usize,
    cells_failed: usize,
    outcomes_differ: usize,
    sequences_agree: Option<usize>,
    event_time_median: Option<Exponent>,
    event_time_p99: Option<Exponent>,
    event_state_median: Option<Exponent>,
    event_state_p99: Option<Exponent>,
    zeta_median: Option<Exponent>,
    zeta_p99: Option<Exponent>,
}

/// The fault of a table that is read.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// It is no table, or lacks a column.
    #[error("{0}; give a chart.csv of topple chart")]
    Csv(#[from] csv::Error),
    /// A name that topple does not give.
    #[error("{0}; give a chart.csv of topple chart")]
    Name(String),
}

/// Reads a table that was written; `benches` are the names of the scenes there are.
///
/// # Errors
/// [`TableError`] where it is not such a table.
pub fn read(reader: impl Read, benches: &[&'static str]) -> Result<Vec<Row>, TableError> {
    let known = |names: &[&'static str], name: &str| {
        let found = names.iter().copied().find(|known| *known == name);
        found.ok_or_else(|| TableError::Name(format!("'{name}' is none of {}", names.join(", "))))
    };
    let spread = |median: Option<Exponent>, p99: Option<Exponent>| {
        median.zip(p99).map(|(Exponent(median), Exponent(p99))| Spread { median, p99 })
    };
    let mut rows = Vec::new();
    for row in csv::Reader::from_reader(reader).deserialize::<Written>() {
        let row = row?;
        let Some(Exponent(setting)) = row.step.or(row.tolerance) else {
            return Err(TableError::Name(format!(
                "{}: neither a step nor a tolerance",
                row.method
            )));
        };
        rows.push(Row {
            bench: known(benches, &row.scene)?,
            method: row.method,
            precision: known(&["f32", "f64"], &row.precision)?,
            steps: row.step.is_some(),
            setting,
            threads: row.threads,
            seconds: row.seconds_a_cell.0,
            device: row.device_seconds_a_cell.map(|device| device.0),
            start: row.start_seconds,
            runs: row.runs,
            errors: Errors {
                cells: row.cells,
                failed: row.cells_failed,
                differ: row.outcomes_differ,
                sequences: row.sequences_agree,
                time: spread(row.event_time_median, row.event_time_p99),
                motion: spread(row.event_state_median, row.event_state_p99),
                zeta: spread(row.zeta_median, row.zeta_p99),
            },
        });
    }
    Ok(rows)
}

/// Writes the table.
pub fn write(rows: &[Row], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    for row in rows {
        let e = &row.errors;
        let median = |of: Option<Spread>| of.map(|of| Exponent(of.median));
        let p99 = |of: Option<Spread>| of.map(|of| Exponent(of.p99));
        let setting = Exponent(row.setting);
        table.serialize(Written {
            scene: row.bench.into(),
            method: row.method.clone(),
            precision: row.precision.into(),
            step: row.steps.then_some(setting),
            tolerance: (!row.steps).then_some(setting),
            threads: row.threads,
            seconds_a_cell: Exponent(row.seconds),
            device_seconds_a_cell: row.device.map(Exponent),
            start_seconds: row.start,
            runs: row.runs,
            cells: e.cells,
            cells_failed: e.failed,
            outcomes_differ: e.differ,
            sequences_agree: e.sequences,
            event_time_median: median(e.time),
            event_time_p99: p99(e.time),
            event_state_median: median(e.motion),
            event_state_p99: p99(e.motion),
            zeta_median: median(e.zeta),
            zeta_p99: p99(e.zeta),
        })?;
    }
    table.flush()?;
    Ok(())
}
