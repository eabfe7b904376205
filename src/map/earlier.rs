//! What an earlier command left in a directory, so that its files do not lie beside those of a new one.

use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::results::files;

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
}

impl Kind {
    /// In words: `a map`.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Map => "a map",
            Kind::History => "a time history",
        }
    }
}

/// What an earlier command left in a directory, as its run.json says.
#[derive(Debug, Default, Deserialize)]
pub struct Earlier {
    /// What it is of; none where it does not say.
    pub kind: Option<Kind>,
    /// The names of its files, but run.json.
    #[serde(default)]
    files: Vec<String>,
}

impl Earlier {
    /// That of a directory; nothing where no run.json of topple is there.
    pub fn of(directory: &Path) -> Earlier {
        // A file that cannot be read or is something else's says nothing; it will be told when it is replaced.
        let text = fs::read(directory.join(RUN)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// True where it is of something else than a new command's files.
    pub fn is_other_than(&self, kind: Kind) -> bool {
        self.kind.is_some_and(|earlier| earlier != kind)
    }

    /// Removes its files that a new command does not write, and its run.json first; those that were there.
    ///
    /// # Errors
    /// Those of the disk.
    pub fn remove_but(&self, new: &[String], directory: &Path) -> io::Result<Vec<String>> {
        // Files without it are a run's that was interrupted.
        files::remove(&directory.join(RUN))?;
        let mut removed = Vec::new();
        for name in self.files.iter().filter(|name| !new.contains(name)) {
            // Nothing outside of the directory, whatever somebody wrote there.
            let is_name = Path::new(name).file_name().is_some_and(|only| only == name.as_str());
            let path = directory.join(name);
            if is_name && path.symlink_metadata().is_ok() {
                files::remove(&path)?;
                removed.push(name.clone());
            }
        }
        Ok(removed)
    }
}
