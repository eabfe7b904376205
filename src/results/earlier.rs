//! What an earlier command left in a directory, so that its files do not lie beside those of a new one.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::results::files::{self, Directory, WriteError};
use crate::results::temporary::{self, ABOUT_TO_WRITE};
use crate::results::{own, zarr};
use crate::scene::bounded;

/// Name of the file that says what was run.
pub const RUN: &str = "run.json";

/// What the files of a directory are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A map.
    Map,
    /// The motion of one cell.
    History,
    /// A set of records.
    Suite,
    /// A sweep under all of one.
    Envelope,
    /// The same at levels of their intensity.
    Fragility,
    /// Devices side by side under a suite.
    Comparison,
    /// The outcomes of many sweeps.
    Probability,
}

impl Kind {
    /// In words: `a map`.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Map => "a map",
            Kind::History => "a time history",
            Kind::Suite => "a suite",
            Kind::Envelope => "an envelope",
            Kind::Fragility => "a fragility",
            Kind::Comparison => "a comparison",
            Kind::Probability => "a probability map",
        }
    }

    /// The name of the command, of a study of a suite.
    pub fn study(self) -> Option<&'static str> {
        match self {
            Kind::Envelope => Some("envelope"),
            Kind::Fragility => Some("fragility"),
            Kind::Comparison => Some("compare"),
            Kind::Map | Kind::History | Kind::Suite | Kind::Probability => None,
        }
    }
}

/// What an earlier command left in a directory, as its run.json says.
#[derive(Debug, Default)]
pub struct Earlier {
    /// What it is of; none where no run.json is there.
    pub kind: Option<Kind>,
    /// What was run, in short: of a map the tag of its identity.
    pub tag: Option<u32>,
    /// The names of its files, but run.json, and those that a run was about to write which ended before its run.json was
    /// there.
    files: Vec<String>,
}

/// Of a run.json of topple, what is requested here. All of it must be there: other programs have a run.json, too.
#[derive(Deserialize)]
struct Written {
    kind: Kind,
    #[serde(rename = "version")]
    _version: String,
    tag: Option<u32>,
    files: Vec<String>,
}

/// Kinds of files that a run writes and the next may remove.
const ENDINGS: [&str; 6] = ["csv", "mat", "npz", "png", "svg", "xml"];
/// The folders among them, and a file of each.
const FOLDERS: ([&str; 2], &str) = ([own::MAP, own::LEAVES], zarr::DOCUMENT);

impl Earlier {
    /// That of a directory; nothing where no run.json is there.
    ///
    /// # Errors
    /// [`WriteError::Foreign`]: a run.json of something else, or one that cannot be read.
    pub fn of(directory: &Path) -> Result<Earlier, WriteError> {
        let begun = bounded::read(&directory.join(ABOUT_TO_WRITE), bounded::DOCUMENT);
        let mut begun: Vec<String> =
            begun.ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
        let path = directory.join(RUN);
        let text = match bounded::read(&path, bounded::DOCUMENT) {
            // Of a file in the directory's place its making tells.
            Err(error)
                if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) =>
            {
                return Ok(Earlier { files: begun, ..Earlier::default() });
            }
            Err(error) if error.kind() == ErrorKind::PermissionDenied => {
                return Err(WriteError::of(&path, &error));
            }
            text => text.unwrap_or_default(),
        };
        match serde_json::from_slice::<Written>(&text) {
            Ok(Written { kind, tag, mut files, .. }) => {
                begun.retain(|name| !files.contains(name));
                files.append(&mut begun);
                Ok(Earlier { kind: Some(kind), tag, files })
            }
            Err(_) => Err(WriteError::Foreign(path)),
        }
    }

    /// Refuses a directory in which something that no run wrote has the place of one of these files or folders.
    ///
    /// # Errors
    /// [`WriteError::Foreign`]; those of the disk.
    pub fn refuse_foreign(&self, new: &[String], directory: &Path) -> Result<(), WriteError> {
        for name in new {
            let path = directory.join(name);
            let is_folder = FOLDERS.0.contains(&name.as_str());
            if is_folder {
                // Under these names it is written, and an earlier one goes.
                for beside in [temporary::begun(name), temporary::aside(name)] {
                    files::free(&directory.join(beside))?;
                }
                files::free(&path)?;
            }
            if let Ok(there) = path.symlink_metadata()
                && (there.is_dir() != is_folder || !self.files.contains(name))
            {
                return Err(WriteError::Foreign(path));
            }
        }
        Ok(())
    }

    /// Makes the directory ready for the files of a new command: says which they are, so that they are known as a run's
    /// wherever the command ends, and removes what it does not write. The names of what was removed.
    ///
    /// # Errors
    /// [`WriteError::Foreign`] as [`Earlier::refuse_foreign`], before anything is removed; those of the disk.
    pub fn begin(&self, new: &[String], out: &Directory) -> Result<Vec<String>, WriteError> {
        self.refuse_foreign(new, out.path())?;
        let others = self.files.iter().filter(|name| !new.contains(name));
        let all: Vec<&String> = new.iter().chain(others).collect();
        out.write(ABOUT_TO_WRITE, |w| serde_json::to_writer(w, &all))?;
        self.remove_but(new, out.path()).map_err(|error| WriteError::of(out.path(), &error))
    }

    /// Removes its files that a new command does not write, and run.json first; those that were there. Of a folder
    /// goes what a run wrote.
    fn remove_but(&self, new: &[String], directory: &Path) -> io::Result<Vec<String>> {
        // Files without it are a run's that was interrupted.
        match fs::remove_file(directory.join(RUN)) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(io::Error::new(error.kind(), format!("{RUN}: {error}")));
            }
            _ => {}
        }
        let mut removed = Vec::new();
        for name in self.files.iter().filter(|name| !new.contains(name)) {
            let path = directory.join(name);
            if is_results(name, &path) {
                match path.is_dir() {
                    true => own::remove(&path, own::Kind::Group).map(|_| ())?,
                    false => own::gone(fs::remove_file(&path))?,
                }
                removed.push(name.clone());
            }
        }
        Ok(removed)
    }
}

/// Writes run.json, which says that all files are there that [`Earlier::begin`] had said.
///
/// # Errors
/// Errors of the disk.
pub fn finish(out: &Directory, manifest: &impl Serialize) -> Result<(), WriteError> {
    out.write(RUN, |w| serde_json::to_writer_pretty(w, manifest))?;
    let begun = out.file(ABOUT_TO_WRITE);
    own::gone(fs::remove_file(&begun)).map_err(|error| WriteError::of(&begun, &error))
}

/// True of a file, or the folder of a map or of leaves, that a run of topple may have written into its directory: whatever
/// somebody wrote into run.json, nothing else is removed.
fn is_results(name: &str, path: &Path) -> bool {
    let plain = Path::new(name);
    let is_name = plain.file_name().is_some_and(|only| only == name);
    let Ok(there) = path.symlink_metadata() else { return false };
    let (folders, inside) = FOLDERS;
    let ending = plain.extension().and_then(|ending| ending.to_str());
    let is_file = there.is_file() && ending.is_some_and(|ending| ENDINGS.contains(&ending));
    is_name
        && (is_file || (folders.contains(&name) && there.is_dir() && path.join(inside).exists()))
}
