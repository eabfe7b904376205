//! Ground-motion records.

mod afad;
pub(crate) mod at2;
pub mod baseline;
pub(crate) mod bbp;
mod channel;
mod clock;
pub(crate) mod columns;
pub mod component;
pub(crate) mod cosmos;
pub(crate) mod csmip;
mod dated;
pub(crate) mod esm;
pub(crate) mod fdsn;
mod floor;
pub(crate) mod geonet;
mod hints;
pub mod joined;
pub(crate) mod knet;
pub(crate) mod lines;
pub mod missing;
pub(crate) mod numbers;
pub mod oscillator;
mod other_programs;
mod packed;
pub(crate) mod pair;
mod plain;
pub(crate) mod provenance;
pub mod read;
mod sac;
mod sequence;
pub(crate) mod smc;
mod stated;
mod steps;
pub mod synthetic;
pub mod text;
mod times;
pub mod treatment;
pub(in crate::scene) mod turned;
mod units;
mod unlikely;
pub mod zips;

use super::bounded;

pub use baseline::Baseline;
pub use component::Component;
pub use hints::RecordHints;
pub use pair::{Beyond, Pair};
pub use provenance::{Provenance, RecordFile, sha256};
pub use stated::Stated;
pub use treatment::Treatment;
pub use units::Units;

/// An acceleration record, evenly sampled.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Record {
    /// What the file says that it is.
    pub title: String,
    /// Time between samples, s.
    pub dt: f64,
    /// Accelerations, m/s^2.
    pub samples: Vec<f64>,
    /// What its file states of it.
    pub stated: Stated,
    /// The decisions of the reader, one sentence each.
    pub notes: Vec<String>,
    /// What may be wrong with its samples, one sentence each.
    pub doubts: Vec<String>,
}

impl Record {
    /// Largest |acceleration|, m/s^2.
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
    }

    /// Time of the last sample, s.
    pub fn duration(&self) -> f64 {
        time_of(self.samples.len().saturating_sub(1), self.dt)
    }
}

/// The time of a sample, s: without the last digits, in which a product of binary numbers misses a decimal one.
fn time_of(sample: usize, dt: f64) -> f64 {
    rounded(sample as f64 * dt, DIGITS)
}

/// What is said of one component, or of one record, among several: each sentence after its name.
fn of_one(name: &str, told: &[String]) -> impl Iterator<Item = String> {
    told.iter().map(move |sentence| format!("{name}: {sentence}"))
}

/// What is said of a file whose accelerations are as they were recorded.
const NOT_CORRECTED: &str = "not corrected by its file";

/// Digits to which times are told: a product of binary numbers misses a decimal one beyond them.
const DIGITS: usize = 13;

/// A number to so many digits.
pub fn rounded(number: f64, digits: usize) -> f64 {
    // What was written as a number is one.
    format!("{number:.*e}", digits.saturating_sub(1)).parse().unwrap_or(number)
}

/// Why bytes are no record.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecordError {
    /// Something is wrong in a line, counted from 1.
    #[error("line {line}: {problem}")]
    Line {
        /// The line.
        line: usize,
        /// The fault and the remedy.
        problem: String,
    },
    /// Something is wrong with the whole.
    #[error("{0}")]
    Whole(String),
    /// It is too large to be held; of a packed file what is in it.
    #[error("larger than {size}; this is no record", size = bounded::size(*most))]
    Large {
        /// Most bytes that are read.
        most: u64,
    },
}

impl RecordError {
    pub(crate) fn line(line: usize, problem: impl Into<String>) -> RecordError {
        RecordError::Line { line, problem: problem.into() }
    }

    pub(crate) fn whole(problem: impl Into<String>) -> RecordError {
        RecordError::Whole(problem.into())
    }
}

/// Samples as a file has them, and what it states of them, before any of it is judged.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Raw {
    pub title: String,
    pub stated: Stated,
    /// Time between samples, where the file tells.
    pub step: Option<Step>,
    /// The words of its units with their line, where the file tells them.
    pub units: Option<(usize, String)>,
    pub values: Vec<f64>,
    pub notes: Vec<String>,
}

/// A time between samples as a file states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    /// The time, s.
    pub seconds: f64,
    /// By how much it may be off, for want of digits.
    pub within: f64,
}

impl Step {
    /// One that is stated to all its digits.
    pub fn exact(seconds: f64) -> Step {
        Step { seconds, within: 1.0e-6 * seconds.abs() }
    }
}
