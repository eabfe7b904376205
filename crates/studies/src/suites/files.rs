//! The files of a suite: those of a folder and of its folders, those in a zip, or those that a list names.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::ops::Deref;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use zip::ZipArchive;

use super::SuiteError;
use super::found::{Found, Unused};
use topple::scene::bounded;
use topple::scene::record::zips;

/// Largest file that is read, bytes.
const LARGEST: u64 = 256 << 20;
/// A smaller one may be read beside others: more of them at once would fill the memory.
const SMALL: u64 = 8 << 20;
/// Most bytes of all files that are read.
const MOST: u64 = 8 << 30;

/// Files by their names: paths within the folder or the zip, with `/` between.
pub struct Files {
    place: PathBuf,
    /// Open, where it is a zip.
    archive: Option<Mutex<ZipArchive<BufReader<File>>>>,
    /// What is there. Beside a list it is looked for where a file is not at its path alone.
    found: OnceLock<Found>,
    /// Bytes that were read.
    read: AtomicU64,
    /// Held by the one large file that is at hand.
    large: Mutex<()>,
}

/// The bytes of a file. Of large files there is one at a time: the next waits until it is dropped.
pub struct Bytes<'a> {
    bytes: Vec<u8>,
    _alone: Option<MutexGuard<'a, ()>>,
}

impl Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.bytes
    }
}

impl Files {
    /// Those of a folder, of a zip, or beside a list.
    ///
    /// # Errors
    /// Those of reading; what is neither a folder nor a file.
    pub fn of(path: &Path) -> Result<Files, SuiteError> {
        let reason = |reason| SuiteError::Read { path: path.into(), reason };
        // A list that is not there is not the folder that it would be in.
        let about = path.metadata().map_err(reason)?;
        let is_zip = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"));
        let (mut place, mut archive, mut found) = (path, None, OnceLock::new());
        if about.is_dir() {
            found = Found::in_folder(path).map_err(reason)?.into();
        } else if !about.is_file() {
            let problem = "a pipe or a device, which lies in no folder of records; save the list as a file beside them";
            return Err(SuiteError::List { path: path.into(), problem: problem.into() });
        } else if is_zip {
            let opened = open(path)?;
            found = Found::in_zip(&opened).map_err(|problem| unreadable(path, problem))?.into();
            archive = Some(Mutex::new(opened));
        } else {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            place = folder.unwrap_or(Path::new("."));
        }
        let (read, large) = (AtomicU64::new(0), Mutex::new(()));
        Ok(Files { place: place.into(), archive, found, read, large })
    }

    /// What is there; beside a list nothing where its folder cannot be looked into.
    fn found(&self) -> &Found {
        self.found.get_or_init(|| Found::in_folder(&self.place).unwrap_or_default())
    }

    /// All names, in alphabetical order.
    pub fn names(&self) -> &[String] {
        &self.found().names
    }

    /// What is no file, and folders that cannot be looked into.
    pub fn others(&self) -> &[Unused] {
        &self.found().others
    }

    /// The name of a file that the list `of` has under a name: the path from the list's own folder, or from the suite's; or of
    /// the files of that name in any folder, whatever the case of its letters, the one whose folders are the list's.
    pub fn find(&self, listed: &str, of: &str) -> Result<String, String> {
        let plain = listed.replace('\\', "/");
        let plain = plain.trim_start_matches("./");
        let folder = of.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        let beside = format!("{folder}{plain}");
        let none = || format!("{listed} is in the list and not among the files");
        let places = [beside.as_str(), plain];
        // Nothing else is looked at where a file is at its path.
        let is_there = |name: &&str| match self.found.get() {
            Some(found) => found.alike(plain).contains(name),
            None => is_within(name) && self.path(name).is_file() && self.link(name).is_none(),
        };
        if let Some(name) = places.into_iter().find(is_there) {
            return Ok(name.into());
        }
        if let Some(link) = places.into_iter().find_map(|name| self.link(name)) {
            return Err(format!(
                "{listed} lies behind {link}, a link to a folder, and links to folders are not followed; put the files \
                 themselves, or links to them, beside the list"
            ));
        }
        let alike = self.found().alike(plain);
        // Folders that they have in common, from the file on.
        let common = |name: &str| {
            let parts = name.rsplit('/').zip(beside.rsplit('/'));
            parts.take_while(|(one, other)| one.eq_ignore_ascii_case(other)).count()
        };
        let most = alike.iter().map(|name| common(name)).max().unwrap_or(0);
        let mut nearest = alike.iter().filter(|name| common(name) == most);
        match (nearest.next(), nearest.next()) {
            (Some(one), None) => Ok((*one).into()),
            (Some(one), Some(other)) => {
                Err(format!("{listed} may be {one} or {other}; give its folder in the list"))
            }
            _ if Path::new(plain).has_root() => Err(format!(
                "{}; a list gives paths from its own folder, and none outside of it",
                none()
            )),
            _ => Err(none()),
        }
    }

    /// The link to a folder that a file lies behind.
    fn link(&self, name: &str) -> Option<String> {
        let parts = Path::new(name).components().map(|part| match part {
            Component::Normal(part) => part.to_str(),
            _ => None,
        });
        let parts: Vec<&str> = parts.collect::<Option<_>>()?;
        let folders = (1..parts.len()).map(|count| parts[..count].join("/"));
        let found = self.archive.is_none() && is_within(name) && self.path(name).is_file();
        folders.filter(|_| found).find(|folder| self.path(folder).is_symlink())
    }

    /// True where there is a file of such a name in some folder.
    pub fn has(&self, listed: &str) -> bool {
        !self.found().alike(&listed.replace('\\', "/")).is_empty()
    }

    /// Where a file lies; of a zip's, the name is below the zip's own.
    pub fn path(&self, name: &str) -> PathBuf {
        let written = self.found.get().and_then(|found| found.written.get(name));
        self.place.join(written.map_or(OsStr::new(name), OsString::as_os_str))
    }

    /// The bytes of a file that may be none of the suite's: in a folder if it has `most` at most, and they count among no others; in a zip
    /// as [`read`](Files::read) has them.
    pub fn peek(&self, name: &str, most: u64) -> Option<Vec<u8>> {
        if self.archive.is_some() {
            return self.read(name).ok().map(|read| read.bytes);
        }
        bounded::read(&self.path(name), most).ok()
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// What is wrong with it, in words; that all files together are too large.
    pub fn read(&self, name: &str) -> Result<Bytes<'_>, String> {
        let read = match &self.archive {
            Some(archive) => {
                // An archive is as it was, whoever panicked: each file is looked for by its place.
                let mut archive = archive.lock().unwrap_or_else(PoisonError::into_inner);
                let written = self.found().written.get(name).and_then(|name| name.to_str());
                let name = written.unwrap_or(name);
                let file = archive.by_name(name).map_err(|error| error.to_string())?;
                self.all(file)
            }
            None => File::open(self.path(name)).and_then(|file| self.all(file)),
        };
        let read = read.map_err(|error| match error.kind() {
            io::ErrorKind::FileTooLarge => format!("{error}; this is no record"),
            _ => error.to_string(),
        })?;
        let bytes = read.bytes.len() as u64;
        if self.read.fetch_add(bytes, Ordering::Relaxed).saturating_add(bytes) > MOST {
            return Err(format!("all files together have more than {}", bounded::size(MOST)));
        }
        Ok(read)
    }

    /// All bytes of a file; a large one waits for its turn.
    fn all(&self, mut file: impl Read) -> io::Result<Bytes<'_>> {
        let mut bytes = Vec::new();
        (&mut file).take(SMALL).read_to_end(&mut bytes)?;
        if (bytes.len() as u64) < SMALL {
            return Ok(Bytes { bytes, _alone: None });
        }
        let alone = self.large.lock().unwrap_or_else(PoisonError::into_inner);
        bytes.extend(bounded::all(file, LARGEST - SMALL).map_err(|error| match error.kind() {
            io::ErrorKind::FileTooLarge => {
                io::Error::new(error.kind(), format!("larger than {}", bounded::size(LARGEST)))
            }
            _ => error,
        })?);
        Ok(Bytes { bytes, _alone: Some(alone) })
    }
}

/// Opens a zip that has no more files than are looked at.
fn open(place: &Path) -> Result<ZipArchive<BufReader<File>>, SuiteError> {
    let read = |reason| SuiteError::Read { path: place.into(), reason };
    let file = File::open(place).map_err(read)?;
    zips::check(&file).map_err(|error| match error.kind() {
        io::ErrorKind::FileTooLarge => unreadable(place, error.to_string()),
        _ => read(error),
    })?;
    let archive = ZipArchive::new(BufReader::new(file));
    archive.map_err(|error| unreadable(place, error.to_string()))
}

fn unreadable(place: &Path, reason: String) -> SuiteError {
    SuiteError::Zip { path: place.into(), reason }
}

/// True of a path that leads to no place outside of its folder.
fn is_within(name: &str) -> bool {
    Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}
