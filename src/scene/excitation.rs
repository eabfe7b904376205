//! What shakes the base.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::applies::Choice;
use super::numbers::Numbers;
use super::parameters::Parameter;
use super::record::{Pair, Provenance, Units, joined};
use super::record::{RecordHints, read};
use super::{SceneError, Values, positive};
use crate::model::pulse::Shape;
use crate::written::Written;

/// What shakes the base.
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

/// The record as written, but for its numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordText {
    /// Horizontal record: AT2, COSMOS, CSMIP, SMC, K-NET, ESM, GeoNet, AFAD, BBP, SAC, one or two columns [default: a
    /// synthetic pair]
    pub horizontal: Option<PathBuf>,
    /// Vertical record, positive up
    pub vertical: Option<PathBuf>,
    /// The channel of the horizontal record's file, where it has several: its number or its direction
    pub horizontal_channel: Option<String>,
    /// That of the vertical record's
    pub vertical_channel: Option<String>,
    /// Time between samples, s, where a file does not tell
    pub dt: Option<f64>,
    /// Units of the values, where a file does not tell
    pub units: Option<Units>,
}

impl RecordText {
    /// The first key that is given; `horizontal` where none is.
    pub fn first_key(&self) -> &'static str {
        match self {
            RecordText { horizontal: None, vertical: Some(_), .. } => "vertical",
            RecordText { horizontal: None, horizontal_channel: Some(_), .. } => {
                "horizontal_channel"
            }
            RecordText { horizontal: None, vertical_channel: Some(_), .. } => "vertical_channel",
            RecordText { horizontal: None, dt: Some(_), .. } => "dt",
            RecordText { horizontal: None, units: Some(_), .. } => "units",
            _ => "horizontal",
        }
    }

    /// The files that a record came from, where they lie now: where they lay, or by their names in one of some
    /// folders.
    ///
    /// # Errors
    /// A file that is not there, or has changed, and what to do.
    pub fn found(record: &Provenance, folders: &[&Path]) -> Result<RecordText, String> {
        Ok(RecordText {
            horizontal: Some(record.horizontal.find(folders)?),
            vertical: record.vertical.as_ref().map(|file| file.find(folders)).transpose()?,
            horizontal_channel: record.horizontal.channel.clone(),
            vertical_channel: record.vertical.as_ref().and_then(|file| file.channel.clone()),
            dt: record.dt,
            units: record.units,
        })
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
    if let Some(dt) = text.dt {
        positive("dt", dt)?;
    }
    let pga = numbers.get(Parameter::Pga);
    let hints = RecordHints {
        dt: text.dt,
        units: text.units,
        scaled: pga.is_some(),
        ..RecordHints::default()
    };
    let read = |key, path: &Path, hints: &RecordHints| {
        let path = directory.join(path);
        let is_vertical = key == "vertical";
        let channel = if is_vertical { &text.vertical_channel } else { &text.horizontal_channel };
        let own =
            RecordHints { vertical: Some(is_vertical), channel: channel.clone(), ..hints.clone() };
        read::file(&path, &own)
            .map_err(|error| SceneError::new(key, format!("{}: {error}", path.display())))
    };
    if let (None, Some(_)) = (&text.vertical, &text.vertical_channel) {
        return Err(SceneError::new(
            "vertical_channel",
            "there is no vertical record; give `vertical`",
        ));
    }
    let Some(horizontal) = &text.horizontal else {
        return Err(SceneError::new("horizontal", "missing; give a record's file"));
    };
    // Where one file tells its own step and units, and the other does not, what is given is meant for the other.
    let own = RecordHints { dt: None, units: None, ..hints.clone() };
    let tells = |key, path: &Path| read(key, path, &own).is_ok();
    let given = text.dt.is_some() || text.units.is_some();
    let pair = text.vertical.as_deref().filter(|_| given);
    let (of_h, of_v) =
        match pair.map(|path| (tells("horizontal", horizontal), tells("vertical", path))) {
            Some((true, false)) => (&own, &hints),
            Some((false, true)) => (&hints, &own),
            _ => (&hints, &hints),
        };
    let horizontal = read("horizontal", horizontal, of_h)?;
    let vertical = text.vertical.as_deref().map(|path| read("vertical", path, of_v)).transpose()?;
    Ok(scaled(joined::join(horizontal, vertical, &hints, force)?, numbers))
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
