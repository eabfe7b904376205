//! The motions of figures: records by name, looked for in a directory of the user's.
//!
//! Where a component's file is missing, the synthetic component of the given peak stands in, and
//! the motion says so.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::ReadError;
use topple::scene::GRAVITY;
use topple::scene::builder::located;
use topple::scene::record::synthetic::{self, HORIZONTAL, Parameters, VERTICAL};
use topple::scene::record::{Pair, Record, Units};
use topple::scene::record::{RecordHints, read};

/// A motion as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionText {
    /// Short name, as in panels: `Kobe`.
    pub name: String,
    /// Event, station and components.
    pub title: String,
    /// The horizontal component.
    pub horizontal: ComponentText,
    /// The vertical one, positive up.
    pub vertical: ComponentText,
}

/// A component as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComponentText {
    /// Name of its file in the directory.
    pub file: String,
    /// Time between samples, s, where the file does not tell.
    pub dt: Option<f64>,
    /// Units of the values, where the file does not tell.
    pub units: Option<Units>,
    /// Peak of the synthetic component that stands in for a missing file, m/s^2.
    pub stand_in: f64,
}

/// A motion ready to shake a base.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Short name.
    pub name: String,
    /// Both components.
    pub pair: Pair,
    /// What it is made of, for captions: one line.
    pub line: String,
    /// Components that are synthetic, each with the file that is missing.
    pub missing: Vec<String>,
    /// The synthetic components, in a word: none, one, or both.
    synthetic: Option<&'static str>,
}

impl Motion {
    /// Its short name, and what of it is synthetic: the title of a panel.
    pub fn label(&self) -> String {
        match self.synthetic {
            None => self.name.clone(),
            Some(which) => format!("{} ({which})", self.name),
        }
    }
}

/// All motions by key.
pub type Motions = BTreeMap<String, MotionText>;

/// Reads the motions' TOML.
///
/// # Errors
/// [`ReadError`] with the line at fault.
pub fn from_toml(place: &str, text: &str) -> Result<Motions, ReadError> {
    toml::from_str(text).map_err(|error| ReadError::new(place, located(text, &error)))
}

impl MotionText {
    /// Opens the files in `directory`; a component without a file is synthetic.
    ///
    /// # Errors
    /// [`ReadError`] where a file is there and is no record.
    pub fn open(&self, directory: Option<&Path>) -> Result<Motion, ReadError> {
        let mut missing = Vec::new();
        let mut parts = Vec::new();
        let mut component = |kind: &str, text: &ComponentText, like: &Parameters| {
            let found = text.open(directory)?;
            let peak =
                |record: &Record| record.samples.iter().fold(0.0, |p: f64, a| p.max(a.abs()));
            let record = match found {
                Some(record) => {
                    parts.push(format!("{kind} {:.3} g", peak(&record) / GRAVITY));
                    record
                }
                None => {
                    missing.push(format!("{}: {kind} synthetic, no {}", self.name, text.file));
                    parts.push(format!(
                        "{kind} SYNTHETIC, {:.3} g ({} is missing)",
                        text.stand_in / GRAVITY,
                        text.file
                    ));
                    synthetic::make("synthetic", &Parameters { peak: text.stand_in, ..*like })
                }
            };
            Ok::<Record, ReadError>(record)
        };
        let is_there = |text: &ComponentText| text.path(directory).is_some();
        let synthetic = match (is_there(&self.horizontal), is_there(&self.vertical)) {
            (true, true) => None,
            (false, true) => Some("horizontal synthetic"),
            (true, false) => Some("vertical synthetic"),
            (false, false) => Some("synthetic"),
        };
        let horizontal = component("horizontal", &self.horizontal, &HORIZONTAL)?;
        let vertical = component("vertical", &self.vertical, &VERTICAL)?;
        let pair = Pair::new(horizontal, Some(vertical));
        let mut pair = pair.map_err(|error| ReadError::new(&self.name, error.to_string()))?;
        let line = format!("{}: {}; {}", self.name, self.title, parts.join(", "));
        pair.title.clone_from(&line);
        Ok(Motion { name: self.name.clone(), pair, line, missing, synthetic })
    }
}

impl ComponentText {
    /// Its file in the directory, where there is one.
    fn path(&self, directory: Option<&Path>) -> Option<PathBuf> {
        directory.map(|directory| directory.join(&self.file)).filter(|path| path.exists())
    }

    /// The file's record; none where there is no such file.
    fn open(&self, directory: Option<&Path>) -> Result<Option<Record>, ReadError> {
        let Some(path) = self.path(directory) else { return Ok(None) };
        let hints =
            RecordHints { dt: self.dt, units: self.units, scaled: false, ..RecordHints::default() };
        let (record, _) = read::file(&path, &hints)
            .map_err(|error| ReadError::new(path.display().to_string(), error.to_string()))?;
        Ok(Some(record))
    }
}
