//! The files of a suite: those of a folder and of its folders, or those in a zip.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::ops::Deref;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use zip::ZipArchive;

use super::SuiteError;
use topple::scene::bounded;
use topple::scene::record::zips::{self, MOST_FILES};

/// Folders within folders that are looked into.
const DEPTH: usize = 6;
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
    names: Vec<String>,
    /// Those of a zip that are written otherwise in it: Windows' programs have backslashes between.
    written: HashMap<String, String>,
    /// The places among the names of those that have one last part, in small letters.
    alike: HashMap<String, Vec<usize>>,
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

/// The last part of a name, in small letters.
fn bare(name: &str) -> String {
    name.rsplit('/').next().unwrap_or_default().to_lowercase()
}

impl Files {
    /// Those of a folder, of a zip, or beside a list.
    ///
    /// # Errors
    /// Those of reading.
    pub fn of(path: &Path) -> Result<Files, SuiteError> {
        // A list that is not there is not the folder that it would be in.
        if let Err(reason) = path.metadata() {
            return Err(SuiteError::Read { path: path.into(), reason });
        }
        let is_zip = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"));
        let place = if path.is_dir() || is_zip {
            path
        } else {
            path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
        };
        let (mut names, mut archive, mut written) = (Vec::new(), None, HashMap::new());
        if is_zip {
            let opened = open(place)?;
            for name in opened.file_names() {
                let name = name.map_err(|error| unreadable(place, error.to_string()))?;
                let plain = name.replace('\\', "/");
                // A Mac packs what it knows of a file beside it.
                let hidden = bare(&plain).starts_with('.') || plain.starts_with("__MACOSX/");
                if plain.ends_with('/') || hidden {
                    continue;
                }
                if plain != *name {
                    written.insert(plain.clone(), name.into_owned());
                }
                names.push(plain);
            }
            archive = Some(Mutex::new(opened));
        } else {
            let reason = |reason| SuiteError::Read { path: place.into(), reason };
            look(place, "", 0, &mut names).map_err(reason)?;
        }
        // The order of a folder is the system's.
        names.sort();
        let mut alike: HashMap<String, Vec<usize>> = HashMap::new();
        for (number, name) in names.iter().enumerate() {
            alike.entry(bare(name)).or_default().push(number);
        }
        let (read, large) = (AtomicU64::new(0), Mutex::new(()));
        Ok(Files { place: place.into(), archive, names, written, alike, read, large })
    }

    /// All names, in alphabetical order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The name of a file that the list `of` has under a name: the path from the list's own folder, or from the suite's; or of
    /// the files of that name in any folder, whatever the case of its letters, the one whose folders are the list's.
    ///
    /// # Errors
    /// Why there is none.
    pub fn find(&self, listed: &str, of: &str) -> Result<&str, String> {
        let plain = listed.replace('\\', "/");
        let plain = plain.trim_start_matches("./");
        let folder = of.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        let beside = format!("{folder}{plain}");
        let none = || format!("{listed} is in the list and not among the files");
        let alike = self.alike.get(&bare(plain)).map_or(&[][..], Vec::as_slice);
        let alike: Vec<&str> = alike.iter().map(|number| self.names[*number].as_str()).collect();
        let same = |wanted: &str| alike.iter().copied().find(|name| *name == wanted);
        if let Some(same) = same(&beside).or_else(|| same(plain)) {
            return Ok(same);
        }
        if let Some(link) = [&beside, plain].into_iter().find_map(|name| self.link(name)) {
            return Err(format!(
                "{listed} lies behind {link}, a link to a folder, and links to folders are not followed; put the files \
                 themselves, or links to them, beside the list"
            ));
        }
        // Folders that they have in common, from the file on.
        let common = |name: &str| {
            let parts = name.rsplit('/').zip(beside.rsplit('/'));
            parts.take_while(|(one, other)| one.eq_ignore_ascii_case(other)).count()
        };
        let most = alike.iter().map(|name| common(name)).max().unwrap_or(0);
        let mut nearest = alike.iter().filter(|name| common(name) == most);
        match (nearest.next(), nearest.next()) {
            (Some(one), None) => Ok(one),
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
        let found = self.archive.is_none() && self.path(name).is_file();
        folders.filter(|_| found).find(|folder| self.path(folder).is_symlink())
    }

    /// True where there is a file of such a name in some folder.
    pub fn has(&self, listed: &str) -> bool {
        self.alike.contains_key(&bare(&listed.replace('\\', "/")))
    }

    /// Where a file lies; of a zip's, the name is below the zip's own.
    pub fn path(&self, name: &str) -> PathBuf {
        self.place.join(name)
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
                let name = self.written.get(name).map_or(name, String::as_str);
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

/// Adds the names of a folder's files, `before` before them. A link to a folder is not followed, as it may lead out of the suite
/// or round in a circle; its own name stands among the files, and is told as one that is not used.
fn look(folder: &Path, before: &str, depth: usize, names: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let kind = entry.file_type()?;
        // A name that is no text is no record's.
        let Ok(name) = entry.file_name().into_string() else { continue };
        if name.starts_with('.') {
            continue;
        }
        let name = format!("{before}{name}");
        if kind.is_dir() && depth < DEPTH {
            look(&entry.path(), &format!("{name}/"), depth + 1, names)?;
        } else if !kind.is_dir() {
            names.push(name);
        }
        if names.len() > MOST_FILES {
            return Err(io::Error::other(format!("more than {MOST_FILES} files")));
        }
    }
    Ok(())
}
