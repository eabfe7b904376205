//! The files of a suite: those of a folder and of its folders, or those in a zip.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use zip::ZipArchive;

use super::SuiteError;

/// Folders within folders that are looked into.
const DEPTH: usize = 6;
/// Most files that are looked at.
const MOST: usize = 100_000;
/// Largest file that is read, bytes.
const LARGEST: u64 = 256 << 20;

/// Files by their names: paths within the folder or the zip, with `/` between.
pub struct Files {
    place: PathBuf,
    is_zip: bool,
    names: Vec<String>,
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
        let mut files = Files { place: place.into(), is_zip, names: Vec::new() };
        if is_zip {
            let archive = files.archive()?;
            for name in archive.file_names() {
                let name = name.map_err(|error| files.unreadable(error.to_string()))?;
                if !name.ends_with('/') && !name.starts_with("__MACOSX/") {
                    files.names.push(name.into_owned());
                }
            }
        } else {
            let reason = |reason| SuiteError::Read { path: place.into(), reason };
            look(place, "", 0, &mut files.names).map_err(reason)?;
        }
        // The order of a folder is the system's.
        files.names.sort();
        Ok(files)
    }

    /// All names, in alphabetical order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The name of a file that a list has under a name: the same path, or a file of that name in any folder,
    /// whatever the case of its letters. None where there are several.
    pub fn find(&self, listed: &str) -> Option<&str> {
        let listed = listed.replace('\\', "/");
        if let Some(same) = self.names.iter().find(|name| **name == listed) {
            return Some(same);
        }
        let bare = |name: &str| name.rsplit('/').next().unwrap_or_default().to_lowercase();
        let mut alike = self.names.iter().filter(|name| bare(name) == bare(&listed));
        alike.next().filter(|_| alike.next().is_none()).map(String::as_str)
    }

    /// Where a file lies; of a zip's, the name is below the zip's own.
    pub fn path(&self, name: &str) -> PathBuf {
        self.place.join(name)
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let read = if self.is_zip {
            let mut archive = self.archive().map_err(|error| error.to_string())?;
            let file = archive.by_name(name).map_err(|error| error.to_string())?;
            file.take(LARGEST + 1).read_to_end(&mut bytes)
        } else {
            fs::File::open(self.path(name))
                .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        };
        read.map_err(|error| error.to_string())?;
        if bytes.len() as u64 > LARGEST {
            return Err("larger than 256 MiB; this is no record".into());
        }
        Ok(bytes)
    }

    fn archive(&self) -> Result<ZipArchive<io::BufReader<fs::File>>, SuiteError> {
        let file = fs::File::open(&self.place);
        let file = file.map_err(|reason| SuiteError::Read { path: self.place.clone(), reason })?;
        let archive = ZipArchive::new(io::BufReader::new(file));
        archive.map_err(|error| self.unreadable(error.to_string()))
    }

    fn unreadable(&self, reason: String) -> SuiteError {
        SuiteError::Zip { path: self.place.clone(), reason }
    }
}

/// Adds the names of a folder's files, `before` before them; folders that are links are passed over.
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
        if names.len() > MOST {
            return Err(io::Error::other(format!("more than {MOST} files")));
        }
    }
    Ok(())
}
