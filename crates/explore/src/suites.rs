//! The suites of a session: what was dropped on the page.

use std::collections::{HashMap, HashSet, VecDeque};
use std::fs;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use hyper::body::Bytes;
use serde_json::{Value, json};
use tempfile::TempDir;

use super::records::plain_name;
use super::refused::Refused;
use super::room::{Room, Taken};
use topple_studies::suites::read::{Suite, is_list};

/// Most suites whose files are kept.
pub const MOST: usize = 16;
/// A suite that is not asked for is let go from memory after this time.
pub const UNUSED: Duration = Duration::from_secs(60);

/// A file that was dropped: its name and its contents.
pub type File = (String, Bytes);

/// The files of a suite in a folder, which goes with it.
struct Files {
    /// The zips and lists among them, by their places in the folder.
    whole: Vec<PathBuf>,
    folder: TempDir,
    _room: Taken,
    /// The suite while it is used. Who reads it has this lock, and no other.
    suite: Mutex<Option<Arc<Suite>>>,
}

/// A suite by its name here, and when it was last asked for.
struct Kept {
    id: String,
    files: Arc<Files>,
    used: Instant,
}

/// The suites of a session, the oldest first. Where they are too many the oldest go.
#[derive(Default)]
pub struct Suites(Mutex<VecDeque<Kept>>);

/// True of a file that is more than a record: a zip, or a list of records.
pub fn is_of_a_suite(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || is_list(bytes)
}

/// A suite in a folder of dropped files: a zip, a list beside its files, or the files themselves; `whole` names the zip or the list.
fn read(folder: &Path, whole: &[PathBuf]) -> Result<Suite, Refused> {
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

/// Lets go of the suites that were not asked for during a time: their files are read again. One that is being read is used.
fn let_go(kept: &VecDeque<Kept>, unused: Duration) {
    for own in kept.iter().filter(|own| own.used.elapsed() >= unused) {
        if let Ok(mut suite) = own.files.suite.try_lock() {
            *suite = None;
        }
    }
}

/// The places of files in the folder of a suite. Each further file of one name, which a folder may have in capitals, too, lies in a
/// folder of its own, whose name no file has.
pub fn places(files: &[File]) -> Vec<PathBuf> {
    let names: Vec<String> = files.iter().map(|(name, _)| plain_name(name)).collect();
    let taken: HashSet<String> = names.iter().map(|name| name.to_lowercase()).collect();
    let mut before: HashMap<String, usize> = HashMap::new();
    let place = |name: &String| {
        let number = before.entry(name.to_lowercase()).or_default();
        *number += 1;
        if *number == 1 {
            return PathBuf::from(name);
        }
        let mut folder = number.to_string();
        while taken.contains(&folder) {
            folder.push('_');
        }
        Path::new(&folder).join(name)
    };
    names.iter().map(place).collect()
}

impl Suites {
    /// Reads a suite from dropped files, and keeps them in a folder that is made for them in `folder`, which has this room.
    /// Where there are more than are kept the oldest go.
    ///
    /// # Errors
    /// That they are none, or have no motion; those of the disk.
    pub fn add(&self, (folder, room): (&Path, &Room), files: &[File]) -> Result<Value, Refused> {
        let room = room.take(files.iter().map(|(_, bytes)| bytes.len() as u64).sum())?;
        let folder = tempfile::Builder::new().prefix("suite-").tempdir_in(folder)?;
        let own = folder.path();
        let id = own.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
        let mut whole = Vec::new();
        for (place, (_, bytes)) in places(files).into_iter().zip(files) {
            let path = own.join(&place);
            fs::create_dir_all(path.parent().unwrap_or(own))?;
            fs::write(path, bytes)?;
            whole.extend(is_of_a_suite(bytes).then_some(place));
        }
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
        let_go(&kept, Duration::ZERO);
        let suite = Mutex::new(Some(Arc::new(suite)));
        let files = Arc::new(Files { whole, folder, _room: room, suite });
        kept.push_back(Kept { id: id.clone(), files, used: Instant::now() });
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
        self.get_by(id, read)
    }

    /// [`Suites::get`] where `read` reads a suite that is not in memory: its folder, and the names of its zip or list.
    pub fn get_by(
        &self,
        id: &str,
        read: impl Fn(&Path, &[PathBuf]) -> Result<Suite, Refused>,
    ) -> Result<Arc<Suite>, Refused> {
        let files = {
            let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            let problem = || format!("{id} is not here; drop the suite's files on the page");
            let known = kept.iter_mut().find(|known| known.id == id);
            let known = known.ok_or_else(|| Refused::of("suite", problem()))?;
            known.used = Instant::now();
            let files = Arc::clone(&known.files);
            let_go(&kept, UNUSED);
            files
        };
        // A large suite takes its time: only those wait who want this one.
        let mut suite = files.suite.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(suite) = &*suite {
            return Ok(Arc::clone(suite));
        }
        let found = Arc::new(read(files.folder.path(), &files.whole)?);
        *suite = Some(Arc::clone(&found));
        Ok(found)
    }

    /// Lets go of what was not used during a time, from memory: asked for while something else is looked at.
    pub fn rest(&self, unused: Duration) {
        let_go(&self.0.lock().unwrap_or_else(PoisonError::into_inner), unused);
    }
}
