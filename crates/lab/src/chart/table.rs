//! chart.csv: one row per trial.

use std::io::{Read, Write};

use serde::Deserialize;

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

/// A row as written, by the names of the columns.
#[derive(Deserialize)]
struct Written {
    scene: String,
    method: String,
    precision: String,
    step: Option<f64>,
    tolerance: Option<f64>,
    threads: usize,
    seconds_a_cell: f64,
    device_seconds_a_cell: Option<f64>,
    start_seconds: f64,
    runs: u32,
    cells: usize,
    cells_failed: usize,
    outcomes_differ: usize,
    sequences_agree: Option<usize>,
    event_time_median: Option<f64>,
    event_time_p99: Option<f64>,
    event_state_median: Option<f64>,
    event_state_p99: Option<f64>,
    zeta_median: Option<f64>,
    zeta_p99: Option<f64>,
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
    let spread = |median: Option<f64>, p99: Option<f64>| {
        median.zip(p99).map(|(median, p99)| Spread { median, p99 })
    };
    let mut rows = Vec::new();
    for row in csv::Reader::from_reader(reader).deserialize::<Written>() {
        let row = row?;
        let Some(setting) = row.step.or(row.tolerance) else {
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
            seconds: row.seconds_a_cell,
            device: row.device_seconds_a_cell,
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

/// Writes the table. A number that there is none of is left empty.
///
/// # Errors
/// Those of the writer.
pub fn write(rows: &[Row], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record([
        "scene",
        "method",
        "precision",
        "step",
        "tolerance",
        "threads",
        "seconds_a_cell",
        "device_seconds_a_cell",
        "start_seconds",
        "runs",
        "cells",
        "cells_failed",
        "outcomes_differ",
        "sequences_agree",
        "event_time_median",
        "event_time_p99",
        "event_state_median",
        "event_state_p99",
        "zeta_median",
        "zeta_p99",
    ])?;
    for row in rows {
        let e = &row.errors;
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
        let spread = |spread: Option<Spread>| {
            [number(spread.map(|s| s.median)), number(spread.map(|s| s.p99))]
        };
        let [time_median, time_p99] = spread(e.time);
        let [motion_median, motion_p99] = spread(e.motion);
        let [zeta_median, zeta_p99] = spread(e.zeta);
        table.write_record([
            row.bench.to_string(),
            row.method.clone(),
            row.precision.to_string(),
            number(row.steps.then_some(row.setting)),
            number((!row.steps).then_some(row.setting)),
            row.threads.to_string(),
            format!("{:e}", row.seconds),
            number(row.device),
            format!("{:.3}", row.start),
            row.runs.to_string(),
            e.cells.to_string(),
            e.failed.to_string(),
            e.differ.to_string(),
            e.sequences.map_or(String::new(), |count| count.to_string()),
            time_median,
            time_p99,
            motion_median,
            motion_p99,
            zeta_median,
            zeta_p99,
        ])?;
    }
    table.flush()?;
    Ok(())
}
