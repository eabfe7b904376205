//! A record as it is written.

use std::path::{Path, PathBuf};

use super::keys::{Place, RECORD_KEYS, RecordKey};
use super::{Provenance, RecordFile, SceneError, Treatment, Units};

/// The record as written, but for its numbers: [`RECORD_KEYS`] says what each key means.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordText {
    /// The horizontal component.
    pub horizontal: Option<PathBuf>,
    /// The vertical component.
    pub vertical: Option<PathBuf>,
    /// The channel of the horizontal component's file.
    pub horizontal_channel: Option<String>,
    /// That of the vertical one's.
    pub vertical_channel: Option<String>,
    /// The second horizontal component.
    pub horizontal_2: Option<PathBuf>,
    /// The channel of its file.
    pub horizontal_2_channel: Option<String>,
    /// The horizontal component of the record that follows.
    pub join: Option<PathBuf>,
    /// Its vertical component.
    pub join_vertical: Option<PathBuf>,
    /// What is made of the components.
    pub treatment: Treatment,
    /// The time between samples, s.
    pub dt: Option<f64>,
    /// The units of the values.
    pub units: Option<Units>,
}

impl RecordText {
    /// The keys that are given, in the order of the table.
    fn given(&self) -> impl Iterator<Item = &'static RecordKey> {
        RECORD_KEYS.iter().filter(|key| key.is_given(self))
    }

    /// The first key that is given; `horizontal` where none is.
    pub fn first_key(&self) -> &'static str {
        self.given().next().map_or("horizontal", |key| key.key)
    }

    /// The first key that makes another motion of the record, where one is given.
    pub fn treated_key(&self) -> Option<&'static str> {
        self.given().find(|key| key.treats).map(|key| key.key)
    }

    /// Checks the numbers, and refuses what says nothing without another key.
    ///
    /// # Errors
    /// The key at fault, with what to do.
    pub fn check(&self) -> Result<(), SceneError> {
        for key in self.given() {
            if let Place::Number(of, holds, must) = key.place
                && let Some(value) = *of(&mut self.clone())
                && !holds(value)
            {
                return Err(SceneError::new(key.key, format!("{value} must {must}")));
            }
        }
        let is_missing = |key: &str| !self.given().any(|given| given.key == key);
        for key in self.given() {
            if let Some(other) = key.needs.filter(|other| is_missing(other)) {
                let problem = format!("it says nothing without `{other}`; give that, too");
                return Err(SceneError::new(key.key, problem));
            }
        }
        if self.treatment.azimuth.is_some() && self.join.is_some() {
            let problem = "a record that is turned and followed by another is not made; turn both apart, or leave \
                           `azimuth` out";
            return Err(SceneError::new("join", problem));
        }
        Ok(())
    }

    /// The files that a record came from, where they lie now: where they lay, or by their names in one of some
    /// folders.
    ///
    /// # Errors
    /// A file that is not there, or has changed, and what to do.
    pub fn found(record: &Provenance, folders: &[&Path]) -> Result<RecordText, String> {
        let place =
            |file: &Option<RecordFile>| file.as_ref().map(|file| file.find(folders)).transpose();
        let channel =
            |file: &Option<RecordFile>| file.as_ref().and_then(|file| file.channel.clone());
        Ok(RecordText {
            horizontal: Some(record.horizontal.find(folders)?),
            vertical: place(&record.vertical)?,
            horizontal_channel: record.horizontal.channel.clone(),
            vertical_channel: channel(&record.vertical),
            horizontal_2: place(&record.horizontal_2)?,
            horizontal_2_channel: channel(&record.horizontal_2),
            join: place(&record.join)?,
            join_vertical: place(&record.join_vertical)?,
            treatment: record.treatment,
            dt: record.dt,
            units: record.units,
        })
    }
}
