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
const MOST: usize = 16;
/// A suite that is not asked for is let go from memory after this time.
const UNUSED: Duration = Duration::from_secs(60);

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
fn places(files: &[File]) -> Vec<PathBuf> {
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

    fn get_by(
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

    /// Lets go of what is not used, from memory: asked for while something else is looked at.
    pub fn rest(&self) {
        let_go(&self.0.lock().unwrap_or_else(PoisonError::into_inner), UNUSED);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT2: &str = "A\nA QUAKE, 1/1/2000, A STATION, 90\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 -.2 .1\n";

    fn file(name: &str, text: &str) -> File {
        (name.into(), text.to_string().into())
    }

    fn files() -> Vec<File> {
        let up = AT2.replace(", 90", ", UP").replace(".1", ".05");
        vec![file("A-090.AT2", AT2), file("A-UP.AT2", &up)]
    }

    fn add(folder: &Path, suites: &Suites, files: &[File]) -> Result<Value, Refused> {
        suites.add((folder, &Room::default()), files)
    }

    #[test]
    fn files_of_one_name_and_one_whose_name_is_a_folders_are_told_apart() {
        for names in [["a", "a", "2"], ["2", "a", "a"], ["a", "2", "A"], ["a", "a", "a"]] {
            let files = names.map(|name| file(name, AT2));
            let placed = places(&files);
            let lower: HashSet<String> =
                placed.iter().map(|place| place.to_string_lossy().to_lowercase()).collect();
            assert_eq!(lower.len(), 3, "{names:?}: {placed:?}");
            let mut inside = placed.iter().filter_map(|place| place.parent());
            assert!(inside.all(|folder| !placed.iter().any(|place| place == folder)));
        }
        // Two pairs of the same names, and a file whose name is that of a folder, wherever it comes.
        let of = |quake: &str| {
            let other = |(name, bytes): File| {
                (name, String::from_utf8_lossy(&bytes).replace("QUAKE", quake).into())
            };
            files().into_iter().map(other).collect::<Vec<File>>()
        };
        for place in 0..5 {
            let mut all = [of("QUAKE"), of("OTHER")].concat();
            all.insert(place, file("2", AT2));
            let folder = tempfile::tempdir().unwrap();
            let told = add(folder.path(), &Suites::default(), &all);
            let told = told.unwrap_or_else(|error| panic!("{place}: {error}"));
            assert_eq!(told["motions"], 2, "{place}: {told}");
        }
    }

    #[test]
    fn nobody_waits_for_a_suite_that_another_reads() {
        let folder = tempfile::tempdir().unwrap();
        let suites = Suites::default();
        let ids = [(), ()].map(|()| {
            let told = add(folder.path(), &suites, &files()).unwrap();
            told["id"].as_str().unwrap().to_string()
        });
        let_go(&suites.0.lock().unwrap(), Duration::ZERO);
        let mut reads = std::cell::Cell::new(0);
        let found = suites.get_by(&ids[0], |folder, whole| {
            reads.set(reads.get() + 1);
            assert!(suites.0.try_lock().is_ok(), "the list of suites is locked");
            suites.rest();
            assert_eq!(suites.get(&ids[1]).unwrap().motions().count(), 1);
            read(folder, whole)
        });
        assert_eq!((found.unwrap().motions().count(), *reads.get_mut()), (1, 1));
    }

    #[test]
    fn suites_have_the_room_of_records_and_leave_it() {
        let folder = tempfile::tempdir().unwrap();
        let (suites, room) = (Suites::default(), Room::default());
        let bytes: u64 = files().iter().map(|(_, bytes)| bytes.len() as u64).sum();
        for _ in 0..MOST + 2 {
            suites.add((folder.path(), &room), &files()).unwrap();
        }
        assert!(suites.add((folder.path(), &room), &[file("a.txt", "x")]).is_err());
        assert_eq!(room.taken(), MOST as u64 * bytes);
    }

    #[test]
    fn the_oldest_suites_go_with_their_files() {
        let folder = tempfile::tempdir().unwrap();
        let suites = Suites::default();
        let add = || {
            let told = add(folder.path(), &suites, &files()).unwrap();
            told["id"].as_str().unwrap().to_string()
        };
        let ids: Vec<String> = (0..MOST + 1).map(|_| add()).collect();
        assert!(suites.get(&ids[0]).is_err() && !folder.path().join(&ids[0]).exists());
        let line = suites.get(&ids[0]).map(|_| ()).unwrap_err().line;
        assert!(line.contains("drop the suite's files on the page"), "{line}");
        assert!(suites.get(&ids[1]).is_ok() && folder.path().join(&ids[1]).exists());
        let is_in_memory = |own: &Kept| own.files.suite.lock().unwrap().is_some();
        // In memory there is what was just asked for, and nothing once it is not used; it comes back from its files.
        let in_memory = || suites.0.lock().unwrap().iter().filter(|own| is_in_memory(own)).count();
        add();
        assert_eq!(in_memory(), 1);
        let_go(&suites.0.lock().unwrap(), Duration::ZERO);
        assert_eq!(in_memory(), 0);
        assert_eq!(suites.get(&ids[MOST]).unwrap().motions().count(), 1);
        // What is no suite leaves nothing.
        let before = fs::read_dir(folder.path()).unwrap().count();
        let other = Suites::default();
        assert!(other.add((folder.path(), &Room::default()), &[file("a.txt", "x")]).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before);
    }

    #[test]
    fn what_is_wrong_names_no_place_of_the_server() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["nothing", "horizontal,dt\nmissing.txt,0.01\n"] {
            let files = [file("a.csv", text)];
            let line = add(folder.path(), &Suites::default(), &files).unwrap_err().line;
            assert!(!line.contains(&*folder.path().to_string_lossy()), "{line}");
        }
    }
}
