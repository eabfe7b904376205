//! Ground-motion records.

pub(crate) mod at2;
pub(crate) mod columns;
pub mod component;
pub(crate) mod cosmos;
pub(crate) mod csmip;
pub(crate) mod esm;
pub mod joined;
pub(crate) mod knet;
pub(crate) mod lines;
pub(crate) mod pair;
pub(crate) mod provenance;
pub mod read;
pub(crate) mod smc;
pub mod synthetic;
mod text;
pub mod zips;

use serde::{Deserialize, Serialize};

use super::bounded;
use crate::written::written;

pub use pair::Pair;
pub use provenance::{Provenance, RecordFile};

/// An acceleration record, evenly sampled.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What the file says that it is.
    pub title: String,
    /// Time between samples, s.
    pub dt: f64,
    /// Accelerations, m/s^2.
    pub samples: Vec<f64>,
    /// What the reader had to decide, in a sentence each.
    pub notes: Vec<String>,
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

/// Digits to which times are told: a product of binary numbers misses a decimal one beyond them.
const DIGITS: usize = 13;

/// A number to so many digits.
pub fn rounded(number: f64, digits: usize) -> f64 {
    // What was written as a number is one.
    format!("{number:.*e}", digits.saturating_sub(1)).parse().unwrap_or(number)
}

written! {
    /// Units of the numbers in a file.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Units {
        /// Multiples of 9.81 m/s^2.
        G = "g",
        /// m/s^2.
        MetresPerSecondSquared = "m/s2",
        /// cm/s^2, gal.
        CentimetresPerSecondSquared = "cm/s2" | "gal",
    }
}

impl Units {
    /// m/s^2 in one of them.
    pub fn factor(self) -> f64 {
        match self {
            Units::G => super::GRAVITY,
            Units::MetresPerSecondSquared => 1.0,
            Units::CentimetresPerSecondSquared => 0.01,
        }
    }

    /// The units that a header's words mean, if they are an acceleration's.
    pub fn named(text: &str) -> Option<Units> {
        let plain: String =
            text.to_lowercase().chars().filter(|c| !c.is_whitespace() && *c != '^').collect();
        match plain.as_str() {
            "g" | "(g)" => Some(Units::G),
            "m/s2" | "m/s/s" | "m/sec2" | "m/sec/sec" => Some(Units::MetresPerSecondSquared),
            "cm/s2" | "cm/s/s" | "cm/sec2" | "cm/sec/sec" | "gal" => {
                Some(Units::CentimetresPerSecondSquared)
            }
            _ => None,
        }
    }
}

/// Why bytes are no record.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecordError {
    /// Something is wrong in a line, counted from 1.
    #[error("line {line}: {problem}")]
    Line {
        /// The line.
        line: usize,
        /// What is wrong and what to do.
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

/// Samples as a file has them: in its units, before any check.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raw {
    pub title: String,
    /// Time between samples, s, where the file tells.
    pub dt: Option<f64>,
    /// Units, where the file tells.
    pub units: Option<Units>,
    pub values: Vec<f64>,
    pub notes: Vec<String>,
}
