//! The directory that a run leaves its files in.

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The directory cannot be made or written to.
    #[error("{path}: {reason}; give a directory that can be written")]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// A file failed while it was written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
}

/// How the names of files begin that are not whole yet.
const TEMPORARY: &str = ".topple-";

/// A name for what is not whole yet, or not needed any more: it goes when the next run begins.
pub fn temporary(name: &str) -> String {
    format!("{TEMPORARY}{name}.old")
}

/// The same of a folder while it is written.
fn begun(name: &str) -> String {
    format!("{TEMPORARY}{name}.new")
}

/// Renames a folder, in the place of one that is there: the path under which that one still lies, to be removed.
///
/// # Errors
/// Those of the disk; what was there is there still, or the new folder is.
pub fn put(from: &Path, place: &Path) -> io::Result<PathBuf> {
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    let aside = place.with_file_name(temporary(&name));
    if place.symlink_metadata().is_ok() {
        remove(&aside)?;
        fs::rename(place, &aside)?;
    }
    if let Err(error) = fs::rename(from, place) {
        // What was there, if anything was.
        let _ = fs::rename(&aside, place);
        return Err(error);
    }
    Ok(aside)
}

/// Removes a file or a folder, if it is there.
///
/// # Errors
/// Those of the disk.
pub fn remove(path: &Path) -> io::Result<()> {
    let removed = match path.symlink_metadata() {
        Ok(there) if there.is_dir() => fs::remove_dir_all(path),
        _ => fs::remove_file(path),
    };
    match removed {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}

/// A directory in which files appear whole or not at all.
#[derive(Debug)]
pub struct Directory {
    path: PathBuf,
}

impl Directory {
    /// Makes the directory if need be, and tries it out.
    ///
    /// # Errors
    /// [`WriteError::Directory`].
    pub fn open(path: &Path) -> Result<Directory, WriteError> {
        let refused = |reason| WriteError::Directory { path: path.to_path_buf(), reason };
        fs::create_dir_all(path).map_err(refused)?;
        tempfile::tempfile_in(path).map_err(refused)?;
        Ok(Directory { path: path.to_path_buf() })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of a file in the directory.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Removes what runs that were killed had begun to write. Call it only while nobody else writes there.
    ///
    /// # Errors
    /// [`WriteError::Directory`].
    pub fn remove_leftovers(&self) -> Result<(), WriteError> {
        self.remove_those(|name| name.starts_with(TEMPORARY))
    }

    /// Removes all that is in it, but some names.
    ///
    /// # Errors
    /// [`WriteError::Directory`].
    pub fn clear(&self, but: &[&str]) -> Result<(), WriteError> {
        self.remove_those(|name| !but.contains(&name))
    }

    fn remove_those(&self, goes: impl Fn(&str) -> bool) -> Result<(), WriteError> {
        let refused = |reason| WriteError::Directory { path: self.path.clone(), reason };
        for entry in fs::read_dir(&self.path).map_err(refused)? {
            let entry = entry.map_err(refused)?;
            if goes(&entry.file_name().to_string_lossy()) {
                remove(&entry.path()).map_err(refused)?;
            }
        }
        Ok(())
    }

    /// Writes a file under a temporary name and renames it once it is whole and on disk. A name may be a path
    /// within the directory, whose folders are made.
    ///
    /// # Errors
    /// [`WriteError::File`], with nothing left behind.
    pub fn write<E: std::fmt::Display>(
        &self,
        name: &str,
        contents: impl FnOnce(&mut BufWriter<&mut fs::File>) -> Result<(), E>,
    ) -> Result<PathBuf, WriteError> {
        let path = self.file(name);
        let failed = |reason: String| WriteError::File { path: path.clone(), reason };
        let folder = self.folder_of(&path).map_err(|e| failed(e.to_string()))?;
        let prefix = format!("{TEMPORARY}{}.", name.replace('/', "-"));
        let mut file =
            NamedTempFile::with_prefix_in(prefix, &self.path).map_err(|e| failed(e.to_string()))?;
        let mut writer = BufWriter::with_capacity(1 << 20, file.as_file_mut());
        contents(&mut writer).map_err(|e| failed(e.to_string()))?;
        writer.flush().map_err(|e| failed(e.to_string()))?;
        drop(writer);
        file.as_file().sync_all().map_err(|e| failed(e.to_string()))?;
        share(file.path()).map_err(|e| failed(e.to_string()))?;
        file.persist(&path).map_err(|e| failed(e.to_string()))?;
        settle(&folder).map_err(|e| failed(e.to_string()))?;
        Ok(path)
    }

    /// Writes the files of a folder under a temporary name and renames it once all are whole and on disk.
    ///
    /// # Errors
    /// [`WriteError`], with nothing left behind, and a folder that was there still there.
    pub fn write_folder(
        &self,
        name: &str,
        contents: impl FnOnce(&Directory) -> Result<(), WriteError>,
    ) -> Result<PathBuf, WriteError> {
        let (path, begun) = (self.file(name), self.file(&begun(name)));
        let failed =
            |reason: io::Error| WriteError::File { path: path.clone(), reason: reason.to_string() };
        let written = || -> Result<(), WriteError> {
            remove(&begun).map_err(failed)?;
            contents(&Directory::open(&begun)?)?;
            let aside = put(&begun, &path).map_err(failed)?;
            settle(&self.path).map_err(failed)?;
            remove(&aside).map_err(failed)
        };
        if let Err(error) = written() {
            // What cannot be removed goes when the next run begins.
            let _ = remove(&begun);
            return Err(error);
        }
        Ok(path)
    }

    /// The folder of a file in the directory, made if need be.
    fn folder_of(&self, path: &Path) -> io::Result<PathBuf> {
        let folder = path.parent().unwrap_or(&self.path).to_path_buf();
        if !folder.is_dir() {
            fs::create_dir_all(&folder)?;
            // The names of those that are new, up to the directory's own.
            for above in
                folder.ancestors().skip(1).take_while(|above| above.starts_with(&self.path))
            {
                settle(above)?;
            }
        }
        Ok(folder)
    }
}

/// Sees to it that a new name in a directory outlives a power cut.
#[cfg(unix)]
fn settle(directory: &Path) -> io::Result<()> {
    match fs::File::open(directory)?.sync_all() {
        // File systems that have no such call keep names in their own way.
        Err(e) if matches!(e.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Ok(()),
        settled => settled,
    }
}

#[cfg(not(unix))]
fn settle(_: &Path) -> io::Result<()> {
    Ok(())
}

/// Gives a temporary file, which is private, the rights of an ordinary one.
#[cfg(unix)]
fn share(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn share(_: &Path) -> io::Result<()> {
    Ok(())
}
