//! The suites of a session: what was dropped on the page.

use std::collections::{HashMap, VecDeque};
use std::fs;
use std::path::{MAIN_SEPARATOR, Path};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use super::records::plain_name;
use super::refused::Refused;
use topple_studies::suites::read::{Suite, is_list};

/// Most suites whose files are kept.
const MOST: usize = 16;
/// A suite that is not asked for is let go from memory after this time.
const UNUSED: Duration = Duration::from_secs(60);

/// The files of a suite in a folder, which goes with it, and the suite while it is used.
struct Kept {
    id: String,
    files: Vec<String>,
    suite: Option<Arc<Suite>>,
    used: Instant,
    folder: TempDir,
}

/// The suites of a session, the oldest first. Where they are too many the oldest go.
#[derive(Default)]
pub struct Suites(Mutex<VecDeque<Kept>>);

/// True of a file that is more than a record: a zip, or a list of records.
pub fn is_of_a_suite(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || is_list(bytes)
}

/// A suite in a folder of dropped files: a zip, a list beside its files, or the files themselves; `whole` names the zip or the list.
fn read(folder: &Path, whole: &[String]) -> Result<Suite, Refused> {
    let mut read = whole.iter().map(|name| Suite::read(&folder.join(name), false));
    let found = match (read.next(), read.find_map(Result::ok)) {
        (None, _) => Suite::read(folder, false),
        (Some(first), other) => first.or_else(|error| other.ok_or(error)),
    };
    // A file is identified by its name, not by its folder.
    found.map_err(|error| {
        let place = folder.display().to_string();
        let within = format!("{place}{MAIN_SEPARATOR}");
        let told = error.to_string().replace(&within, "").replace(&place, "these files");
        Refused::of("suite", told)
    })
}

/// Lets go of the suites that were not asked for during a time: their files are read again.
fn let_go(kept: &mut VecDeque<Kept>, unused: Duration) {
    for own in kept.iter_mut().filter(|own| own.used.elapsed() >= unused) {
        own.suite = None;
    }
}

impl Suites {
    /// Reads a suite from dropped files, names with contents, and keeps them in a folder that is made for them in `folder`.
    /// Where there are more than are kept the oldest go.
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
        let whole = files.iter().filter(|(_, bytes)| is_of_a_suite(bytes));
        let whole: Vec<String> = whole.map(|(name, _)| plain_name(name)).collect();
        let suite = read(own, &whole)?;
        let motions = suite.motions().count();
        if motions == 0 {
            let why = suite.left_out().next().map_or("", |(_, why)| why);
            return Err(Refused::of("suite", format!("no motion among these files: {why}")));
        }
        let left_out = suite.left_out().count();
        let doubts =
            match suite.motions().filter(|(_, motion)| !motion.pair.doubts.is_empty()).count() {
                0 => String::new(),
                doubtful => format!(", {doubtful} may have wrong samples: topple suite says why"),
            };
        // What is stored is whole, whoever panicked.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // One suite is looked at: the others are read again when they are.
        let_go(&mut kept, Duration::ZERO);
        let (suite, used) = (Some(Arc::new(suite)), Instant::now());
        kept.push_back(Kept { id: id.clone(), files: whole, suite, used, folder });
        while kept.len() > MOST {
            kept.pop_front();
        }
        let mut line = match left_out {
            0 => format!("{motions} motions"),
            _ => format!("{motions} motions, {left_out} left out"),
        };
        line += &doubts;
        Ok(json!({ "id": id, "motions": motions, "left_out": left_out, "line": line }))
    }

    /// A suite by its name here.
    ///
    /// # Errors
    /// The key `suite`: a name that is not known; files that have gone since.
    pub fn get(&self, id: &str) -> Result<Arc<Suite>, Refused> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let problem = || format!("{id} is not here; drop the suite's files on the page");
        let known = kept.iter_mut().find(|known| known.id == id);
        let known = known.ok_or_else(|| Refused::of("suite", problem()))?;
        let suite = match &known.suite {
            Some(suite) => Arc::clone(suite),
            None => Arc::new(read(known.folder.path(), &known.files)?),
        };
        (known.suite, known.used) = (Some(Arc::clone(&suite)), Instant::now());
        let_go(&mut kept, UNUSED);
        Ok(suite)
    }

    /// Lets go of what is not used, from memory: asked for while something else is looked at.
    pub fn rest(&self) {
        let_go(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner), UNUSED);
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
        // In memory there is what was just asked for, and nothing once it is not used; it comes back from its files.
        let in_memory =
            || suites.0.lock().unwrap().iter().filter(|own| own.suite.is_some()).count();
        add();
        assert_eq!(in_memory(), 1);
        let_go(&mut suites.0.lock().unwrap(), Duration::ZERO);
        assert_eq!(in_memory(), 0);
        assert_eq!(suites.get(&ids[MOST]).unwrap().motions().count(), 1);
        // What is no suite leaves nothing.
        let before = fs::read_dir(folder.path()).unwrap().count();
        assert!(suites.add(folder.path(), &[("a.txt".into(), b"x".to_vec())]).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before);
    }

    #[test]
    fn what_is_wrong_names_no_place_of_the_server() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["nothing", "horizontal,dt\nmissing.txt,0.01\n"] {
            let files = [("a.csv".to_string(), text.as_bytes().to_vec())];
            let line = Suites::default().add(folder.path(), &files).unwrap_err().line;
            assert!(!line.contains(&*folder.path().to_string_lossy()), "{line}");
        }
    }
}
