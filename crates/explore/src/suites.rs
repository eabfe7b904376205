//! The suites of a session: what was dropped on the page.

use std::collections::{HashMap, VecDeque};
use std::fs;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};
use tempfile::TempDir;

use super::records::plain_name;
use super::refused::Refused;
use topple_studies::suites::SuiteError;
use topple_studies::suites::read::Suite;

/// Samples of all suites that are kept, 4 GiB with both components: two suites that are as large as one may be.
const KEPT: usize = 1 << 28;
/// Most suites that are kept: of each the files lie on the disk, too.
const MOST: usize = 16;

/// A suite, and the folder of its files, which goes with it.
struct Kept {
    id: String,
    suite: Arc<Suite>,
    samples: usize,
    _folder: TempDir,
}

/// The suites of a session, the oldest first. Where they are too many the oldest go.
#[derive(Default)]
pub struct Suites(Mutex<VecDeque<Kept>>);

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

/// Leaves out the oldest until there are so many samples at most; the newest stays.
fn leave_out(kept: &mut VecDeque<Kept>, most: usize) {
    let samples = |kept: &VecDeque<Kept>| kept.iter().map(|kept| kept.samples).sum::<usize>();
    while kept.len() > 1 && (kept.len() > MOST || samples(kept) > most) {
        kept.pop_front();
    }
}

impl Suites {
    /// Reads a suite from dropped files, names with contents, and keeps it; a folder is made for them in `folder`. Where
    /// there is more than is kept the oldest suites go.
    ///
    /// # Errors
    /// That they are none, or have no motion; those of the disk.
    pub fn add(&self, folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Value, Refused> {
        let folder = tempfile::Builder::new().prefix("suite-").tempdir_in(folder)?;
        let own = folder.path();
        let id = own.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        let mut names = HashMap::new();
        for (name, bytes) in files {
            // Files of one name lie in folders of their own.
            let name = plain_name(name);
            let before: &mut u32 = names.entry(name.clone()).or_default();
            let place = match *before {
                0 => own.to_path_buf(),
                number => own.join(format!("{}", number + 1)),
            };
            *before += 1;
            fs::create_dir_all(&place)?;
            fs::write(place.join(name), bytes)?;
        }
        let suite = read(own, files)?;
        let motions = suite.motions().count();
        if motions == 0 {
            let why = suite.left_out().next().map_or("", |(_, why)| why);
            return Err(Refused::of("suite", format!("no motion among these files: {why}")));
        }
        let left_out = suite.left_out().count();
        // What is stored is whole, whoever panicked.
        let samples = suite.motions().map(|(_, motion)| motion.pair.len()).sum();
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push_back(Kept { id: id.clone(), suite: Arc::new(suite), samples, _folder: folder });
        leave_out(&mut kept, KEPT);
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
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let problem = || format!("{id} is not here; drop the suite's files on the page");
        let known = kept.iter().find(|known| known.id == id);
        known.map(|known| Arc::clone(&known.suite)).ok_or_else(|| Refused::of("suite", problem()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT2: &str = "A\nA QUAKE, 1/1/2000, A STATION, 90\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 -.2 .1\n";

    fn files() -> Vec<(String, Vec<u8>)> {
        let up = AT2.replace(", 90", ", UP").replace(".1", ".05");
        [("A-090.AT2", AT2), ("A-UP.AT2", &up)]
            .map(|(name, text)| (name.to_string(), text.as_bytes().to_vec()))
            .to_vec()
    }

    #[test]
    fn the_oldest_suites_go_with_their_files() {
        let folder = tempfile::tempdir().unwrap();
        let suites = Suites::default();
        let add = || {
            let told = suites.add(folder.path(), &files()).unwrap();
            told["id"].as_str().unwrap().to_string()
        };
        let ids: Vec<String> = (0..MOST + 1).map(|_| add()).collect();
        assert!(suites.get(&ids[0]).is_err() && !folder.path().join(&ids[0]).exists());
        let line = suites.get(&ids[0]).map(|_| ()).unwrap_err().line;
        assert!(line.contains("drop the suite's files on the page"), "{line}");
        assert!(suites.get(&ids[1]).is_ok() && folder.path().join(&ids[1]).exists());
        // Each has three samples.
        leave_out(&mut suites.0.lock().unwrap(), 7);
        assert!(suites.get(&ids[MOST - 2]).is_err());
        assert!(suites.get(&ids[MOST - 1]).is_ok() && suites.get(&ids[MOST]).is_ok());
        // The newest stays, whatever it has.
        leave_out(&mut suites.0.lock().unwrap(), 0);
        assert!(suites.get(&ids[MOST]).is_ok());
        // What is no suite leaves nothing.
        let before = fs::read_dir(folder.path()).unwrap().count();
        assert!(suites.add(folder.path(), &[("a.txt".into(), b"x".to_vec())]).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before);
    }
}
