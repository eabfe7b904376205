//! The excitation of the base.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::applies::Choice;
use super::numbers::Numbers;
use super::parameters::Parameter;
use super::record::ACCEPTED;
use super::record::treatment::GAP;
use super::record::turned::turned;
use super::record::{Pair, Provenance, Record, RecordFile, RecordHints, RecordText, Treatment};
use super::record::{joined, read};
use super::{SceneError, Values};
use crate::Written;
use crate::model::pulse::Shape;

/// The excitation of the base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Excitation {
    /// A pulse of a shape in both directions, (22).
    Pulse(Shape),
    /// A ground-motion record.
    Record(Pair),
}

impl Excitation {
    /// What the pulse is called, where it is no one-sine.
    pub fn other_pulse(&self) -> Option<&'static str> {
        match self {
            Excitation::Pulse(shape) if *shape != Shape::default() => Some(shape.words()),
            _ => None,
        }
    }

    /// Where the record came from, where there is one that was read from files.
    pub fn provenance(&self) -> Option<&Provenance> {
        self.record()?.provenance.as_deref()
    }

    /// The record, where there is one.
    pub fn record(&self) -> Option<&Pair> {
        match self {
            Excitation::Pulse(_) => None,
            Excitation::Record(pair) => Some(pair),
        }
    }
}

/// Checks that a pulse has its numbers, and no other's.
pub(super) fn complete_pulse(shape: Shape, numbers: &mut Numbers) -> Result<(), SceneError> {
    if ![Parameter::Omega, Parameter::AH].iter().any(|parameter| numbers.has(*parameter)) {
        let problem = "nothing shakes the base: give `omega` and `a_h` of a pulse, or a record's \
                       `horizontal`";
        return Err(SceneError::new("omega", problem));
    }
    for parameter in [Parameter::Omega, Parameter::AH] {
        if !numbers.has(parameter) {
            let problem = "missing; give a number or start:stop:count";
            return Err(SceneError::new(parameter.key(), problem));
        }
    }
    numbers.set_missing(Parameter::AV, 0.0);
    if let Some(given) = numbers.excluded_by(Choice::Shape(shape)) {
        let own: Vec<&str> = given.entry().applies.shape.iter().map(|shape| shape.key()).collect();
        let have = if own.len() == 1 { "has" } else { "have" };
        let problem = format!("a {} has none; {} {have} it", shape.words(), own.join(" and "));
        return Err(SceneError::new(given.key(), problem));
    }
    if shape.is_modulated() {
        numbers.set_missing(Parameter::Gamma, 2.0);
        numbers.set_missing(Parameter::Phase, 0.0);
    }
    Ok(())
}

/// The checked motion, scaled by the scene's factor or to its peak; files are looked for from `directory`.
pub fn check_record(
    text: &RecordText,
    numbers: &Numbers,
    directory: &Path,
    force: bool,
) -> Result<Pair, SceneError> {
    text.check()?;
    let hints = hints_of(text, numbers, force);
    if let (None, Some(_)) = (&text.vertical, &text.vertical_channel) {
        return Err(SceneError::new(
            "vertical_channel",
            "there is no vertical record; give `vertical`",
        ));
    }
    let Some(horizontal) = &text.horizontal else {
        return Err(SceneError::new("horizontal", "missing; give a record's file"));
    };
    let [horizontal, vertical, second] = read_together(
        [
            ("horizontal", Some(horizontal), &text.horizontal_channel),
            ("vertical", text.vertical.as_ref(), &text.vertical_channel),
            ("horizontal_2", text.horizontal_2.as_ref(), &text.horizontal_2_channel),
        ],
        &hints,
        directory,
    )?;
    let Some((mut record, file)) = horizontal else {
        return Err(SceneError::new("horizontal", "missing; give a record's file"));
    };
    let mut horizontal_2 = None;
    if let (Some((other, other_file)), Some(azimuth)) = (second, text.treatment.azimuth) {
        record = turned(record, other, azimuth, &text.treatment, force)?;
        horizontal_2 = Some(other_file);
    }
    let mut pair = joined::join((record, file), vertical, &hints, force)?;
    if let Some(provenance) = &mut pair.provenance {
        provenance.horizontal_2 = horizontal_2;
        provenance.treatment = text.treatment;
    }
    treated(pair, (text, numbers), &hints, directory, force)
}

/// A motion at hand, with what a scene makes of it: the record that follows, the floor, the factor.
pub(super) fn check_motion(
    pair: Pair,
    text: &RecordText,
    numbers: &Numbers,
    directory: &Path,
    force: bool,
) -> Result<Pair, SceneError> {
    text.check()?;
    if text.horizontal_2.is_some() {
        let problem =
            "the motion at hand has one horizontal component; give `horizontal` as a file";
        return Err(SceneError::new("horizontal_2", problem));
    }
    let hints = hints_of(text, numbers, force);
    treated(pair, (text, numbers), &hints, directory, force)
}

/// What is said of all files of a record.
fn hints_of(text: &RecordText, numbers: &Numbers, force: bool) -> RecordHints {
    RecordHints {
        dt: text.dt,
        units: text.units,
        scaled: numbers.get(Parameter::Pga).is_some(),
        force,
        baseline: text.treatment.baseline,
        ..RecordHints::default()
    }
}

/// The key of a file, the file, and its channel.
type Asked<'a> = (&'static str, Option<&'a PathBuf>, &'a Option<String>);

/// Reads the files of one motion.
fn read_together<const N: usize>(
    files: [Asked<'_>; N],
    hints: &RecordHints,
    directory: &Path,
) -> Result<[Option<(Record, RecordFile)>; N], SceneError> {
    let read = |key: &'static str, path: &Path, channel: &Option<String>, hints: &RecordHints| {
        let path = directory.join(path);
        let own = RecordHints {
            vertical: Some(key.ends_with("vertical")),
            second: key == "horizontal_2",
            channel: channel.clone(),
            ..hints.clone()
        };
        read::file(&path, &own)
            .map_err(|error| SceneError::new(key, format!("{}: {error}", path.display())))
    };
    // Where one file tells its own step and units, and another does not, what is given is meant for the other.
    let own = RecordHints { dt: None, units: None, ..hints.clone() };
    let given = hints.dt.is_some() || hints.units.is_some();
    let several = files.iter().filter(|(_, path, _)| path.is_some()).count() > 1;
    let tells = files.map(|(key, path, channel)| match path {
        Some(path) if given && several => Some(read(key, path, channel, &own).is_ok()),
        _ => None,
    });
    let mixed = tells.contains(&Some(true)) && tells.contains(&Some(false));
    let mut records = [const { None }; N];
    for ((record, (key, path, channel)), tells) in records.iter_mut().zip(files).zip(tells) {
        let hints = if mixed && tells == Some(true) { &own } else { hints };
        *record = path.map(|path| read(key, path, channel, hints)).transpose()?;
    }
    Ok(records)
}

/// A motion with the record that follows it, on its floor, scaled.
fn treated(
    mut pair: Pair,
    (text, numbers): (&RecordText, &Numbers),
    hints: &RecordHints,
    directory: &Path,
    force: bool,
) -> Result<Pair, SceneError> {
    let Treatment { join_gap, floor_period, .. } = text.treatment;
    if let Some(join) = &text.join {
        let files =
            [("join", Some(join), &None), ("join_vertical", text.join_vertical.as_ref(), &None)];
        let [horizontal, vertical] = read_together(files, hints, directory)?;
        if let Some(horizontal) = horizontal {
            // A fault of the second record is not one of the first.
            let of_join = |error: SceneError| match error.key {
                "horizontal" => SceneError { key: "join", ..error },
                "vertical" => SceneError { key: "join_vertical", ..error },
                _ => error,
            };
            let next = joined::join(horizontal, vertical, hints, force).map_err(of_join)?;
            pair = pair
                .followed_by(join_gap.unwrap_or(GAP), &next)
                .map_err(|error| SceneError::new("join", error.to_string()))?;
            if let (Some(own), Some(other)) = (&mut pair.provenance, next.provenance) {
                own.join = Some(other.horizontal);
                own.join_vertical = other.vertical;
            }
        }
    }
    if let Some(period) = floor_period {
        pair = pair.floor(period, &text.treatment)?;
    }
    check_factors(&pair, numbers, force)?;
    Ok(scaled(pair, numbers))
}

/// Refuses factors of a scene that make more of a motion than a ground does, unless that is forced.
///
/// # Errors
/// The key `scale`, with the factor and the peak after it.
pub fn check_factors(pair: &Pair, numbers: &Numbers, force: bool) -> Result<(), SceneError> {
    let factors = numbers.get(Parameter::Scale).into_iter().flat_map(Values::iter);
    match factors
        .filter_map(|factor| pair.beyond(factor))
        .find(|beyond| !force || !beyond.is_finite())
    {
        Some(beyond) => Err(SceneError::new("scale", format!("{beyond}; {ACCEPTED}"))),
        None => Ok(()),
    }
}

/// A motion scaled by a scene's factor, or to its peak. Several factors or peaks are the cells' own.
pub fn scaled(pair: Pair, numbers: &Numbers) -> Pair {
    let single = |parameter| numbers.get(parameter).and_then(Values::single);
    match (single(Parameter::Scale), single(Parameter::Pga)) {
        (Some(scale), _) => pair.scaled(scale),
        (None, Some(pga)) => {
            let factor = pga / pair.pga_h;
            pair.scaled(factor)
        }
        (None, None) => pair,
    }
}
