//! From bytes to a record: which format, which units, and is it plausible.

use std::io::Read;
use std::path::Path;

use super::text::{self, LARGEST, printable};
use super::{Raw, Record, RecordError, Units};
use super::{at2, columns, cosmos, csmip, esm, knet, smc};
use crate::scene::GRAVITY;

/// What the user says of a record file, where the file itself does not say it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RecordHints {
    /// Time between samples, s.
    pub dt: Option<f64>,
    /// Units of the values.
    pub units: Option<Units>,
    /// The record is scaled to a known peak, so that its own is not questioned.
    pub scaled: bool,
}

/// Peaks that a record of a strong earthquake may have, in g. The largest on record is near 4.4.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 1.0e-4..=5.0;

/// Reads a file.
///
/// # Errors
/// A [`RecordError`] that names the line at fault.
pub fn file(path: &Path, hints: &RecordHints) -> Result<Record, RecordError> {
    let refused =
        |e: std::io::Error| RecordError::whole(format!("{e}; give a file that can be read"));
    // A device or a pipe has no length to be asked for.
    let mut read = Vec::new();
    let file = std::fs::File::open(path).map_err(refused)?;
    file.take(LARGEST + 1).read_to_end(&mut read).map_err(refused)?;
    if read.len() as u64 > LARGEST {
        return Err(RecordError::whole("larger than 256 MiB; this is no record"));
    }
    bytes(&read, hints)
}

/// Reads the bytes of a file.
///
/// # Errors
/// A [`RecordError`] that names the line at fault.
pub fn bytes(bytes: &[u8], hints: &RecordHints) -> Result<Record, RecordError> {
    let (text, note) = text::of(bytes)?;
    let text = text.as_str();
    let mut raw = if knet::matches(text) {
        knet::read(text)?
    } else if esm::matches(text) {
        esm::read(text)?
    } else if cosmos::matches(text) {
        cosmos::read(text)?
    } else if smc::matches(text) {
        smc::read(text)?
    } else if csmip::matches(text) {
        csmip::read(text)?
    } else if at2::matches(text) {
        at2::read(text)?
    } else {
        columns::read(text)?
    };
    raw.notes.extend(note);
    check(raw, hints)
}

fn check(raw: Raw, hints: &RecordHints) -> Result<Record, RecordError> {
    let Raw { title, dt, units, values, notes } = raw;
    let title = printable(&title);
    if values.len() < 2 {
        return Err(RecordError::whole("fewer than two samples; this is no record"));
    }
    let dt = match (dt, hints.dt) {
        (Some(read), Some(given)) if (read - given).abs() > 1.0e-6 * read.abs() => {
            let problem = format!("the file's step is {read} s, dt says {given} s; leave dt out");
            return Err(RecordError::whole(problem));
        }
        (Some(read), _) => read,
        (None, Some(given)) => given,
        (None, None) => {
            return Err(RecordError::whole("the file does not tell its time step; give dt"));
        }
    };
    if !(dt.is_finite() && dt > 0.0 && dt <= 1.0) {
        return Err(RecordError::whole(format!("a time step of {dt} s is no record's")));
    }
    let units = match (units, hints.units) {
        (Some(read), Some(given)) if read != given => {
            let (read, given) = (read.name(), given.name());
            let problem =
                format!("the file's units are {read}, units says {given}; leave units out");
            return Err(RecordError::whole(problem));
        }
        (Some(units), _) | (None, Some(units)) => units,
        (None, None) => {
            let problem = "the file does not tell its units; give units (g, m/s2 or cm/s2)";
            return Err(RecordError::whole(problem));
        }
    };
    let samples: Vec<f64> = values.iter().map(|value| value * units.factor()).collect();
    let record = Record { title, dt, samples, notes };
    let peak = record.peak() / GRAVITY;
    if !(peak > 0.0 && peak.is_finite()) {
        return Err(RecordError::whole("every sample is zero; this is no record"));
    }
    if !hints.scaled && !PLAUSIBLE.contains(&peak) {
        let problem = format!(
            "a peak of {peak:.3e} g is not plausible for an acceleration in these units; give the \
             right units (or another file, if this is velocity or displacement), or scale it to a \
             known peak by pga"
        );
        return Err(RecordError::whole(problem));
    }
    Ok(record)
}
