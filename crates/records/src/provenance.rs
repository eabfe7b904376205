//! Where a record came from: its files, their checksums, and what was read in them.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};

use super::text::LARGEST;
use super::{Treatment, Units, bounded, path_text, shown};

/// The files of a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// That of the horizontal component.
    pub horizontal: RecordFile,
    /// That of the vertical component, where there is one.
    pub vertical: Option<RecordFile>,
    /// The time between samples as the user gave it, s; none where the files tell it.
    pub dt: Option<f64>,
    /// The units as the user gave them; none where the files tell them.
    pub units: Option<Units>,
    /// The second horizontal component of a record that was turned to an azimuth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub horizontal_2: Option<RecordFile>,
    /// The horizontal component of the record that follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub join: Option<RecordFile>,
    /// Its vertical component.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub join_vertical: Option<RecordFile>,
    /// What was made of them.
    #[serde(default, skip_serializing_if = "Treatment::is_none")]
    pub treatment: Treatment,
}

/// A file of a record, as it was read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordFile {
    /// Where it lay: an absolute path; in a document as [`path_text`] has it.
    #[serde(with = "path_text")]
    pub path: PathBuf,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
    /// Its format: `PEER AT2`.
    pub format: String,
    /// What it says that it is.
    pub title: String,
    /// The channel that was requested, of a file with several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<String>,
    /// Its units.
    pub units: Units,
    /// Time between its samples, s.
    pub dt: f64,
    /// How many samples it has.
    pub samples: usize,
    /// Its largest |acceleration| before any scaling, m/s^2.
    pub peak: f64,
}

/// SHA-256 of bytes, in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    Hash::hash(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Provenance {
    /// Its files.
    pub fn files(&self) -> impl Iterator<Item = &RecordFile> {
        let others = [&self.horizontal_2, &self.join, &self.join_vertical, &self.vertical];
        [&self.horizontal].into_iter().chain(others.into_iter().flatten())
    }

    /// The same with the names of the files in the place of their paths, which differ from machine to machine.
    pub fn without_folders(&self) -> Provenance {
        let bare = |file: &RecordFile| RecordFile {
            path: file.path.file_name().unwrap_or_default().into(),
            ..file.clone()
        };
        Provenance {
            horizontal: bare(&self.horizontal),
            vertical: self.vertical.as_ref().map(bare),
            horizontal_2: self.horizontal_2.as_ref().map(bare),
            join: self.join.as_ref().map(bare),
            join_vertical: self.join_vertical.as_ref().map(bare),
            ..*self
        }
    }
}

impl RecordFile {
    /// Where the file lies now: its own path, or one of its name in the given folders, if its bytes are the same.
    ///
    /// # Errors
    /// What is in its place, and the remedy.
    pub fn find(&self, folders: &[&Path]) -> Result<PathBuf, String> {
        let name = self.path.file_name().unwrap_or_default();
        let places = folders.iter().map(|folder| folder.join(name));
        let mut changed = None;
        for place in std::iter::once(self.path.clone()).chain(places) {
            // A larger file was no record's.
            match bounded::read(&place, LARGEST) {
                Ok(bytes) if sha256(&bytes) == self.sha256 => return Ok(place),
                Ok(_) => changed = changed.or(Some(place)),
                Err(error) if error.kind() == ErrorKind::FileTooLarge => {
                    changed = changed.or(Some(place));
                }
                Err(_) => {}
            }
        }
        Err(match changed {
            Some(place) => format!(
                "{} has changed since that run; restore the file that it used (SHA-256 {})",
                shown::line(&place.display().to_string()),
                shown::shown(&self.sha256)
            ),
            None => format!(
                "the record {} is not there; put it into the directory of the results (SHA-256 {})",
                shown::line(&self.path.display().to_string()),
                shown::shown(&self.sha256)
            ),
        })
    }
}
