//! From bytes to a record: which format, which units, and is it plausible.

use std::borrow::Cow;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::hints::RecordHints;
use super::provenance::sha256;
use super::shown::shown;
use super::steps::SHORTEST_STEP;
use super::text::{self, LARGEST, SMALL, printable};
use super::{
    GRAVITY, Raw, Record, RecordError, RecordFile, Stated, Step, Units, Written, afad, at2, bbp,
    bounded, columns, cosmos, csmip, esm, fdsn, geonet, knet, missing, packed, rounded, sac, smc,
};

/// Peaks that a record of a strong earthquake may have, in g. The largest on record is near 4.4.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 1.0e-4..=5.0;

/// Most letters of a title: a line may be a megabyte long.
const TITLE: usize = 400;

/// Longest time between samples that is still taken for a record's, s.
const LONGEST_STEP: f64 = 0.25;

/// Reads a file: its record, and where that came from. A record without a title is called by its file.
///
/// # Errors
/// A [`RecordError`] that names the line at fault.
pub fn file(path: &Path, hints: &RecordHints) -> Result<(Record, RecordFile), RecordError> {
    let read = bounded::read(path, LARGEST).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => RecordError::Large { most: LARGEST },
        _ => RecordError::whole(format!("{error}; give a file that can be read")),
    })?;
    of_bytes(path, &read, hints)
}

/// The same of a file's bytes, which lie at `path`.
///
/// # Errors
/// A [`RecordError`] that names the line at fault.
pub fn of_bytes(
    path: &Path,
    bytes: &[u8],
    hints: &RecordHints,
) -> Result<(Record, RecordFile), RecordError> {
    let (mut record, format, units) = parsed(bytes, hints)?;
    if record.title.is_empty() {
        let name = path.file_name().unwrap_or(path.as_os_str());
        record.title = printable(&name.to_string_lossy());
    }
    let file = RecordFile {
        path: std::path::absolute(path).unwrap_or_else(|_| path.into()),
        sha256: sha256(bytes),
        format,
        title: record.title.clone(),
        channel: record.stated.channel.clone(),
        units,
        dt: record.dt,
        samples: record.samples.len(),
        peak: record.peak(),
    };
    Ok((record, file))
}

/// Reads the bytes of a file.
///
/// # Errors
/// A [`RecordError`] that names the line at fault.
pub fn bytes(bytes: &[u8], hints: &RecordHints) -> Result<Record, RecordError> {
    parsed(bytes, hints).map(|(record, ..)| record)
}

/// A format: its name, how a file of this format is recognised, and how it is read.
type Format = (&'static str, fn(&str) -> bool, fn(&str, &RecordHints) -> Result<Raw, RecordError>);

/// The formats, in the order in which they are looked for: any text may be columns.
const FORMATS: [Format; 11] = [
    ("AFAD", afad::matches, afad::read),
    ("K-NET", knet::matches, knet::read),
    ("ESM", esm::matches, esm::read),
    ("COSMOS", cosmos::matches, cosmos::read),
    ("SMC", smc::matches, smc::read),
    ("GeoNet", geonet::matches, geonet::read),
    ("CSMIP", csmip::matches, csmip::read),
    ("PEER AT2", at2::matches, at2::read),
    ("Broadband Platform", bbp::matches, bbp::read),
    ("FDSN text", fdsn::matches, fdsn::read),
    (COLUMNS, |_| true, columns::read),
];

/// The name of the format of plain numbers.
pub(super) const COLUMNS: &str = "columns";

/// The name of the one format that is no text.
const SAC: &str = "SAC";

/// The name of the format that a text is a record's in, if it is one of those that have a heading.
pub fn format_of(text: &str) -> Option<&'static str> {
    let own = FORMATS.iter().filter(|(name, ..)| *name != COLUMNS);
    own.clone().find(|(_, matches, _)| matches(text)).map(|(name, ..)| *name)
}

/// The record in the bytes of a file, the name of their format, and their units.
fn parsed(bytes: &[u8], hints: &RecordHints) -> Result<(Record, String, Units), RecordError> {
    match packed::unpacked(bytes, SMALL) {
        Err(RecordError::Large { .. }) => {
            // What is stored is nothing, whoever panicked.
            let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
            of_unpacked(packed::unpacked(bytes, LARGEST)?, hints)
        }
        found => of_unpacked(found?, hints),
    }
}

/// Held while a large file is unpacked and read: of a suite's there is one at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// The record in bytes, with the note of how they were packed.
fn of_unpacked(
    (bytes, note): (Cow<'_, [u8]>, Option<String>),
    hints: &RecordHints,
) -> Result<(Record, String, Units), RecordError> {
    let (name, mut raw) = if sac::matches(&bytes) {
        (SAC, sac::read(&bytes)?)
    } else {
        let text = text::decoded(&bytes)?;
        drop(bytes);
        let [.., columns] = &FORMATS;
        let (name, _, read) =
            FORMATS.iter().find(|(_, matches, _)| matches(&text)).unwrap_or(columns);
        (*name, read(&text, hints)?)
    };
    raw.stated.format = name;
    if let (Some(asked), None) = (&hints.channel, &raw.stated.channel) {
        let problem = format!(
            "a file of {name} has one channel; leave `{}` ('{}') out",
            hints.channel_key(),
            shown(asked)
        );
        return Err(RecordError::whole(problem));
    }
    let (record, units) = check(raw, hints)?;
    // How a file is packed is nothing that its motion depends on.
    let format = note.map_or_else(|| name.to_string(), |note| format!("{name}, {note}"));
    Ok((record, format, units))
}

/// Judges what a file states, beside what the user says: the one place where that is decided, for all formats.
fn check(raw: Raw, hints: &RecordHints) -> Result<(Record, Units), RecordError> {
    let Raw { title, stated, step, units, values, mut notes } = raw;
    let (title, format) = (short(&title), &stated.format);
    if values.len() < 2 {
        return Err(RecordError::whole("fewer than two samples; this is no record"));
    }
    let dt = match (step, hints.dt) {
        (Some(Step { seconds, within }), Some(given)) if (seconds - given).abs() > within => {
            let problem =
                format!("the file's step is {seconds} s, `dt` says {given} s; leave `dt` out");
            return Err(RecordError::whole(problem));
        }
        (Some(Step { seconds, .. }), Some(given)) => {
            if (seconds - given).abs() > 1.0e-9 * given {
                notes.push(format!("the step is {given} s, as given; the file has {seconds} s"));
            }
            given
        }
        (Some(Step { seconds, .. }), None) => seconds,
        (None, Some(given)) => given,
        (None, None) => {
            return Err(RecordError::whole("the file does not tell its time step; give `dt`"));
        }
    };
    if !(SHORTEST_STEP..=LONGEST_STEP).contains(&dt) {
        let hint = if dt == 1.0 {
            "; a column that counts samples is no time: give `dt`"
        } else if *format == COLUMNS && hints.dt.is_none() {
            "; if the times are not in s, name their unit in a heading such as time (ms), acc (g), or give `dt`"
        } else {
            ""
        };
        return Err(RecordError::whole(format!("a time step of {dt} s is no record's{hint}")));
    }
    let units = units.map(|(line, words)| known_units(line, &words)).transpose()?;
    let right = match units {
        Some(_) => "correct the units in the file",
        None => "give the right `units`",
    };
    let units = match (units, hints.units) {
        (Some(read), Some(given)) if read != given => {
            let (read, given) = (read.key(), given.key());
            let problem = format!(
                "the file's units are {read}, `units` says {given}; leave `units` out, or correct the file"
            );
            return Err(RecordError::whole(problem));
        }
        (Some(units), _) | (None, Some(units)) => units,
        (None, None) => {
            let problem = "the file does not tell its units; give `units` (g, m/s2 or cm/s2)";
            return Err(RecordError::whole(problem));
        }
    };
    let samples: Vec<f64> = values.iter().map(|value| value * units.factor()).collect();
    let stated = Stated { event: short(&stated.event), station: short(&stated.station), ..stated };
    let doubts = missing::told(&values).into_iter().collect();
    let record = Record { title, dt, samples, stated, notes, doubts };
    let peak = record.peak() / GRAVITY;
    // A ground that does not move vertically may be given as zeros.
    if peak == 0.0 && hints.vertical == Some(true) {
        return Ok((record, units));
    }
    if !(peak > 0.0 && peak.is_finite()) {
        let problem = "every sample is zero; zeros may be a vertical component alone: give a file with a motion";
        return Err(RecordError::whole(problem));
    }
    if !hints.scaled && !PLAUSIBLE.contains(&peak) {
        let problem = format!(
            "a peak of {} g is not plausible for an acceleration in these units; {right} (or give another file, if this \
             is velocity or displacement), or scale it to a known peak by `pga`",
            rounded(peak, 4)
        );
        return Err(RecordError::whole(problem));
    }
    Ok((record.on_baseline(hints.baseline), units))
}

/// A text of a file as titles have it.
fn short(text: &str) -> String {
    printable(text).chars().take(TITLE).collect()
}

/// The units that the words of a file mean; they stand in a line, or follow from the format.
fn known_units(line: usize, words: &str) -> Result<Units, RecordError> {
    Units::named(words).ok_or_else(|| {
        let problem = format!(
            "units of '{}' are not read; convert the values to g, m/s2 or cm/s2",
            shown(words)
        );
        RecordError::line(line, problem)
    })
}
