//! What is in a folder and in its folders, or in a zip: the names of its files, and what is no file.

use std::collections::HashMap;
use std::ffi::{OsStr, OsString};
use std::fmt::Write;
use std::fs::{self, File};
use std::io::{self, BufReader};
use std::path::Path;

use zip::ZipArchive;

/// Folders within folders that are looked into.
const DEPTH: usize = 6;
/// Most files of a folder and its folders whose names are held; most of them are no records.
const MOST: usize = 1_000_000;

/// A file that no motion is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unused {
    /// Its name.
    pub file: String,
    /// What it is, and why it is not used.
    pub why: String,
}

/// What is in a folder and in its folders, or in a zip.
#[derive(Default)]
pub(super) struct Found {
    /// Paths with `/` between, in alphabetical order.
    pub names: Vec<String>,
    /// Those that are written otherwise where they lie: Windows' programs have backslashes between in a zip, and a name that is
    /// no text has its other bytes as `%E9`.
    pub written: HashMap<String, OsString>,
    /// What is no file, and folders that cannot be looked into.
    pub others: Vec<Unused>,
    /// The places among the names of those that have one last part, in small letters.
    alike: HashMap<String, Vec<usize>>,
}

/// The last part of a name, in small letters.
fn bare(name: &str) -> String {
    name.rsplit('/').next().unwrap_or_default().to_lowercase()
}

/// A name as text: bytes that are none as URLs have them.
fn as_text(name: &OsStr) -> String {
    let mut text = String::new();
    for chunk in name.as_encoded_bytes().utf8_chunks() {
        text.push_str(chunk.valid());
        for byte in chunk.invalid() {
            // Writing to a text does not fail.
            let _ = write!(text, "%{byte:02X}");
        }
    }
    text
}

impl Found {
    /// What is in a folder.
    ///
    /// # Errors
    /// Those of reading the folder itself; more files than are held.
    pub fn in_folder(folder: &Path) -> io::Result<Found> {
        let mut found = Found::default();
        found.look(folder, "", Path::new(""), 0)?;
        Ok(found.sorted())
    }

    /// What is in a zip.
    ///
    /// # Errors
    /// A name that cannot be read, in words.
    pub fn in_zip(archive: &ZipArchive<BufReader<File>>) -> Result<Found, String> {
        let mut found = Found::default();
        for name in archive.file_names() {
            let name = name.map_err(|error| error.to_string())?;
            let plain = name.replace('\\', "/");
            // A Mac packs what it knows of a file beside it.
            let hidden = bare(&plain).starts_with('.') || plain.starts_with("__MACOSX/");
            if plain.ends_with('/') || hidden {
                continue;
            }
            if plain != *name {
                found.written.insert(plain.clone(), name.into_owned().into());
            }
            found.names.push(plain);
        }
        Ok(found.sorted())
    }

    /// The order of a folder is the system's.
    fn sorted(mut self) -> Found {
        self.names.sort();
        for (number, name) in self.names.iter().enumerate() {
            self.alike.entry(bare(name)).or_default().push(number);
        }
        self
    }

    /// The names whose last part is that of a name, whatever the case of its letters.
    pub fn alike(&self, name: &str) -> Vec<&str> {
        let alike = self.alike.get(&bare(name)).map_or(&[][..], Vec::as_slice);
        alike.iter().map(|number| self.names[*number].as_str()).collect()
    }

    /// Adds what is in a folder, with `before` before its names and the folder's own path from the suite's. A link to a folder is
    /// not followed, as it may lead out of the suite or round in a circle; its own name stands among the files, and is told as one
    /// that is not used.
    fn look(&mut self, folder: &Path, before: &str, own: &Path, depth: usize) -> io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let written = entry.file_name();
            let text = as_text(&written);
            if text.starts_with('.') {
                continue;
            }
            let (name, path) = (format!("{before}{text}"), own.join(&written));
            let mut kind = entry.file_type()?;
            if kind.is_symlink()
                && let Ok(about) = entry.path().metadata()
                && !about.is_dir()
            {
                kind = about.file_type();
            }
            if kind.is_dir() && depth < DEPTH {
                let inside = self.look(&entry.path(), &format!("{name}/"), &path, depth + 1);
                match inside {
                    Err(error) if error.kind() == io::ErrorKind::FileTooLarge => return Err(error),
                    Err(error) => {
                        self.other(name, format!("a folder that cannot be read ({error})"))
                    }
                    Ok(()) => {}
                }
            } else if kind.is_dir() {
                self.other(
                    name,
                    format!("a folder within more than {DEPTH} others, which is not looked into"),
                );
            } else if !kind.is_file() && !kind.is_symlink() {
                self.other(name, "a pipe, a socket or a device, no file".into());
            } else {
                if path.to_str().is_none() {
                    self.written.insert(name.clone(), path.into_os_string());
                }
                self.names.push(name);
            }
            if self.names.len() > MOST {
                let problem = format!("more than {MOST} files");
                return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
            }
        }
        Ok(())
    }

    fn other(&mut self, file: String, why: String) {
        self.others.push(Unused { file, why });
    }
}
