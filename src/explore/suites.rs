//! The suites of a session: what was dropped on the page.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};

use super::records::plain_name;
use super::refused::Refused;
use crate::suites::SuiteError;
use crate::suites::read::Suite;

/// The suites of a session, by names.
#[derive(Default)]
pub struct Suites(Mutex<HashMap<String, Arc<Suite>>>);

/// A suite in a folder of dropped files: a zip, a list beside its files, or the files themselves.
fn read(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Suite, SuiteError> {
    let ends = |name: &str, ending: &str| name.to_ascii_lowercase().ends_with(ending);
    if let [(name, _)] = files
        && ends(name, ".zip")
    {
        return Suite::read(&folder.join(plain_name(name)), false);
    }
    let lists = files.iter().filter(|(name, _)| ends(name, ".csv"));
    let mut as_list = lists.map(|(name, _)| Suite::read(&folder.join(plain_name(name)), false));
    as_list.find_map(Result::ok).map_or_else(|| Suite::read(folder, false), Ok)
}

impl Suites {
    /// Reads a suite from dropped files, names with contents, and keeps it; a folder is made for them in `folder`.
    ///
    /// # Errors
    /// That they are none, or have no motion; those of the disk.
    pub fn add(&self, folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Value, Refused> {
        let own = tempfile::Builder::new().prefix("suite-").tempdir_in(folder)?.keep();
        let id = own.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        let mut names = HashMap::new();
        for (name, bytes) in files {
            // Files of one name lie in folders of their own.
            let name = plain_name(name);
            let before: &mut u32 = names.entry(name.clone()).or_default();
            let place = match *before {
                0 => own.clone(),
                number => own.join(format!("{}", number + 1)),
            };
            *before += 1;
            fs::create_dir_all(&place)?;
            fs::write(place.join(name), bytes)?;
        }
        let suite = read(&own, files)?;
        let motions = suite.motions().count();
        if motions == 0 {
            let why = suite.left_out().next().map_or("", |(_, why)| why);
            return Err(Refused::of("suite", format!("no motion among these files: {why}")));
        }
        let left_out = suite.left_out().count();
        // What is stored is whole, whoever panicked.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(id.clone(), Arc::new(suite));
        let line = match left_out {
            0 => format!("{motions} motions"),
            _ => format!("{motions} motions, {left_out} left out"),
        };
        Ok(json!({ "id": id, "motions": motions, "left_out": left_out, "line": line }))
    }

    /// A suite by its name here.
    ///
    /// # Errors
    /// The key `suite`: a name that is not known.
    pub fn get(&self, id: &str) -> Result<Arc<Suite>, Refused> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let problem = || format!("{id} is not here; drop the suite's files on the page");
        known.get(id).cloned().ok_or_else(|| Refused::of("suite", problem()))
    }
}
