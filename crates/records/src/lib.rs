//! Ground-motion records: files are read as accelerations, and components brought together as the motion of a scene.
//!
//! [`read`] takes a file's bytes, finds its format, and hands them to the reader of that format; [`joined`] makes a [`Pair`] of
//! two components. The crate stands below the engine and knows nothing of it. What both need of texts and files is here, too:
//! [`bounded`], [`path_text`], [`shown`], and the words of choices ([`Written`]).

mod afad;
mod at2;
pub mod baseline;
mod bbp;
pub mod bounded;
mod channel;
pub mod clock;
pub mod columns;
pub mod component;
mod cosmos;
mod csmip;
pub mod dated;
mod esm;
mod fdsn;
mod floor;
mod geonet;
mod hints;
pub mod joined;
pub mod keys;
mod knet;
pub mod lines;
pub mod missing;
pub mod numbers;
pub mod oscillator;
pub mod other_programs;
pub mod packed;
mod pair;
pub mod path_text;
mod plain;
mod provenance;
pub mod read;
mod record_text;
mod sac;
mod scene_error;
mod sequence;
pub mod shown;
mod smc;
pub mod stated;
mod steps;
pub mod synthetic;
pub mod text;
pub mod times;
pub mod treatment;
pub mod turned;
mod units;
pub mod unlikely;
mod written;
pub mod zips;

pub use baseline::Baseline;
pub use component::Component;
pub use hints::RecordHints;
pub use pair::{Beyond, Pair};
pub use provenance::{Provenance, RecordFile, sha256};
pub use record_text::RecordText;
pub use scene_error::{ACCEPTED, SceneError};
pub use stated::Stated;
pub use treatment::Treatment;
pub use units::Units;
pub use written::Written;

/// g, m/s^2.
pub const GRAVITY: f64 = 9.81;

/// The largest peak that is plausible, m/s^2: the same before a factor, after it, and of one that is given.
pub const LARGEST_PEAK: f64 = 100.0;

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
pub struct Raw {
    /// What the file says that it is.
    pub title: String,
    /// What it states of its motion.
    pub stated: Stated,
    /// Time between samples, where the file tells.
    pub step: Option<Step>,
    /// The words of its units with their line, where the file tells them.
    pub units: Option<(usize, String)>,
    /// The samples, in its units.
    pub values: Vec<f64>,
    /// The decisions of the reader, one sentence each.
    pub notes: Vec<String>,
}

/// A time between samples as a file states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
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
