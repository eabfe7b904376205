//! The directory that a run leaves its files in.

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::busy::patiently;
use super::own::{self, Kind};
use super::temporary;

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
    /// What no run wrote lies where a run is to write, or to remove what it wrote.
    #[error("{0} was written by no run and is in the way; move it, or give another directory")]
    Foreign(PathBuf),
}

impl WriteError {
    /// That of a file or a folder, by what the system says.
    pub fn of(path: &Path, reason: &io::Error) -> WriteError {
        WriteError::File { path: path.into(), reason: reason.to_string() }
    }
}

/// Renames a folder of a run, in the place of one that is there: the path under which that one still lies, to be removed.
///
/// # Errors
/// [`WriteError::Foreign`] where it would go with what no run wrote; those of the disk. What was there is there still, or
/// the new folder is.
pub fn put(from: &Path, place: &Path) -> Result<PathBuf, WriteError> {
    let failed =
        |reason: io::Error| WriteError::File { path: place.into(), reason: reason.to_string() };
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    let aside = place.with_file_name(temporary::aside(&name));
    if place.symlink_metadata().is_ok() {
        free(place)?;
        remove(&aside)?;
        patiently(|| fs::rename(place, &aside)).map_err(failed)?;
    }
    if let Err(error) = patiently(|| fs::rename(from, place)) {
        // What was there, if anything was.
        let _ = fs::rename(&aside, place);
        return Err(failed(error));
    }
    Ok(aside)
}

/// Refuses a place for a folder of a run where something is that no run wrote, a link to a folder too: a run makes none.
///
/// # Errors
/// [`WriteError::Foreign`]; those of the disk.
pub fn free(place: &Path) -> Result<(), WriteError> {
    if place.is_symlink() {
        return Err(WriteError::Foreign(place.into()));
    }
    let foreign = own::foreign(place, Kind::Group);
    refused(foreign.map_err(|error| WriteError::of(place, &error))?)
}

/// Removes what a run wrote into a folder, and the folder, if it is there.
///
/// # Errors
/// [`WriteError::Foreign`] where something else is in it, which stays; those of the disk.
pub fn remove(folder: &Path) -> Result<(), WriteError> {
    if folder.is_symlink() {
        return Err(WriteError::Foreign(folder.into()));
    }
    let stays = own::remove(folder, Kind::Group);
    refused(stays.map_err(|error| WriteError::of(folder, &error))?)
}

fn refused(foreign: Option<PathBuf>) -> Result<(), WriteError> {
    foreign.map_or(Ok(()), |path| Err(WriteError::Foreign(path)))
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
        temporary_file("try", path).map_err(refused)?;
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

    /// Removes what runs that were killed had begun to write: files, and of folders of this name those that were being
    /// written or removed. Call it only while nobody else writes there.
    ///
    /// # Errors
    /// [`WriteError::Directory`].
    pub fn remove_leftovers(&self, folders: &[&str]) -> Result<(), WriteError> {
        let refused = |reason| WriteError::Directory { path: self.path.clone(), reason };
        for entry in fs::read_dir(&self.path).map_err(refused)? {
            let entry = entry.map_err(refused)?;
            let is_file = entry.file_type().map_err(refused)?.is_file();
            if is_file && temporary::is_file(&entry.file_name().to_string_lossy()) {
                own::gone(fs::remove_file(entry.path())).map_err(refused)?;
            }
        }
        for name in folders.iter().flat_map(|name| [temporary::begun(name), temporary::aside(name)])
        {
            // What no run wrote stays, a link and what it leads to as well; where it is in the way of the new run, that
            // says so.
            if !self.file(&name).is_symlink() {
                own::remove(&self.file(&name), Kind::Group).map_err(refused)?;
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
        let mut file = temporary_file(name, &self.path).map_err(|e| failed(e.to_string()))?;
        let mut writer = BufWriter::with_capacity(1 << 20, file.as_file_mut());
        contents(&mut writer).map_err(|e| failed(e.to_string()))?;
        writer.flush().map_err(|e| failed(e.to_string()))?;
        drop(writer);
        file.as_file().sync_all().map_err(|e| failed(e.to_string()))?;
        named(file, &path).map_err(|e| failed(e.to_string()))?;
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
        let (path, begun) = (self.file(name), self.file(&temporary::begun(name)));
        let written = || -> Result<(), WriteError> {
            remove(&begun)?;
            contents(&Directory::open(&begun)?)?;
            let aside = put(&begun, &path)?;
            settle(&self.path).map_err(|error| WriteError::of(&self.path, &error))?;
            remove(&aside)
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

/// Gives a file that is whole its name.
fn named(file: NamedTempFile, path: &Path) -> io::Result<()> {
    let mut left = Some(file);
    patiently(|| {
        left.take().map_or(Ok(()), |file| {
            file.persist(path).map(drop).map_err(|refused| {
                left = Some(refused.file);
                refused.error
            })
        })
    })
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

/// A file that is not whole yet, with the rights that any new file gets: those that the process's mask leaves.
fn temporary_file(name: &str, folder: &Path) -> io::Result<NamedTempFile> {
    let (before, after) = temporary::file(name);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&before).suffix(after).rand_bytes(temporary::RANDOM);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
