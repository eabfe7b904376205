//! What a run writes into a folder, told by its names, so that this is removed and nothing else: whoever put another file
//! there finds it again.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::columns::TABLE;
use super::listed::{CELL, COUNTS, LEAF_HEIGHT};
use super::temporary;
use super::zarr::{CHUNKS, DOCUMENT, PROVED};
use crate::scene::parameters::PARAMETERS;

/// Name of the file of a sweep's identity.
pub const IDENTITY: &str = "identity.json";
/// Name of a finished shard's report.
pub const REPORT: &str = "report.json";
/// Name of the file of a shard with the samples of its record: of the horizontal ones and then of the vertical ones the eight
/// bytes of each, the lowest first.
pub const SAMPLES: &str = "samples.f64";
/// Name of a map's group in a run's directory.
pub const MAP: &str = "map.zarr";
/// That of the leaves of a refined one.
pub const LEAVES: &str = "leaves.zarr";
/// How the names of folders of lists begin.
pub const LISTS: &str = "lists";
/// How the names of a list's file begins; a number follows.
pub const ROUND: &str = "round-";
/// Digits of a motion's name, those of a SHA-256.
const DIGITS: usize = 64;

/// Whose names those in a folder are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A map's or a list's, whole or while its sweep runs: a Zarr group, and what a sweep keeps beside its arrays.
    Group,
    /// What a sweep leaves that was killed before it had said whose the folder is.
    Empty,
    /// The saved motions of a suite.
    Motions,
    /// The saved lists of cells within a group.
    Lists,
}

impl Kind {
    /// True of a file's path within the folder, or of that of a folder in it.
    fn writes(self, path: &[String], is_folder: bool) -> bool {
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        match (self, &path[..]) {
            (_, [name]) if !is_folder && temporary::is_file(name) => true,
            (Kind::Group, path) => of_group(path, is_folder),
            (Kind::Empty, _) => false,
            (Kind::Motions, [name]) => !is_folder && is_motion(name),
            (Kind::Lists, [name]) => !is_folder && is_round(name),
            (Kind::Motions | Kind::Lists, _) => false,
        }
    }
}

/// True of the name of a motion's file.
pub fn is_motion(name: &str) -> bool {
    name.len() == DIGITS && name.bytes().all(|digit| b"0123456789abcdef".contains(&digit))
}

/// True of what a group has: documents and chunks of arrays, lists, and what tells a sweep.
fn of_group(path: &[&str], is_folder: bool) -> bool {
    match path {
        [name] if !is_folder => [DOCUMENT, IDENTITY, REPORT, SAMPLES].contains(name),
        [name] => is_array(name) || is_lists(name),
        [array, DOCUMENT] => !is_folder && is_array(array),
        [array, CHUNKS, index @ ..] => {
            is_array(array)
                && index.iter().all(|index| is_number(index))
                && (is_folder || !index.is_empty())
        }
        [lists, name] if !is_folder && is_lists(lists) => {
            temporary::is_file(name) || is_round(name)
        }
        _ => false,
    }
}

/// True of the name of an array: a column, an axis, or what a list counts.
fn is_array(name: &str) -> bool {
    let columns =
        TABLE.iter().map(|entry| entry.name).chain([PROVED, CELL, LEAF_HEIGHT]).chain(COUNTS);
    columns.chain(PARAMETERS.iter().map(|entry| entry.key)).any(|known| known == name)
}

/// True of the name of a list's file: `round-00012`.
fn is_round(name: &str) -> bool {
    name.strip_prefix(ROUND).is_some_and(is_number)
}

/// True of the name of a folder of lists: `lists-177x177`.
pub fn is_lists(name: &str) -> bool {
    let sides = name.strip_prefix(LISTS).and_then(|rest| rest.strip_prefix('-')?.split_once('x'));
    sides.is_some_and(|(columns, rows)| is_number(columns) && is_number(rows))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit())
}

/// What is in a folder.
#[derive(Default)]
struct Found {
    /// The run's files.
    files: Vec<PathBuf>,
    /// Its folders, those within before those around them.
    folders: Vec<PathBuf>,
    /// The first of what is not the run's.
    foreign: Option<PathBuf>,
}

impl Found {
    fn look(&mut self, folder: &Path, kind: Kind, within: &mut Vec<String>) -> io::Result<()> {
        let mut entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            let (path, there) = (entry.path(), entry.file_type()?);
            // A name that is no text is nobody's of a run; a link is none of its files.
            within.push(entry.file_name().to_string_lossy().into_owned());
            let own = !there.is_symlink() && kind.writes(within, there.is_dir());
            match (own, there.is_dir()) {
                (true, true) => self.look(&path, kind, within)?,
                (true, false) => self.files.push(path),
                (false, _) => {
                    self.foreign.get_or_insert(path);
                }
            }
            within.pop();
        }
        self.folders.push(folder.to_path_buf());
        Ok(())
    }
}

/// The first thing in a folder that no run wrote, or that which stands in the folder's place; none where nothing is there.
///
/// # Errors
/// Errors of the disk.
pub fn foreign(folder: &Path, kind: Kind) -> io::Result<Option<PathBuf>> {
    // A link may lead to a folder, such as one on another disk.
    match fs::metadata(folder) {
        Ok(there) if there.is_dir() => {}
        Ok(_) => return Ok(Some(folder.to_path_buf())),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Ok(folder.symlink_metadata().ok().map(|_| folder.to_path_buf()));
        }
        Err(error) => return Err(error),
    }
    let mut found = Found::default();
    found.look(folder, kind, &mut Vec::new())?;
    Ok(found.foreign)
}

/// Removes what a run wrote into a folder, [`IDENTITY`] last, and the folder where nothing else is in it; the first thing
/// that stays, if any does.
///
/// # Errors
/// Errors of the disk.
pub fn remove(folder: &Path, kind: Kind) -> io::Result<Option<PathBuf>> {
    if folder.symlink_metadata().is_err_and(|error| error.kind() == ErrorKind::NotFound) {
        return Ok(None);
    }
    if !folder.is_dir() {
        return Ok(Some(folder.to_path_buf()));
    }
    let mut found = Found::default();
    found.look(folder, kind, &mut Vec::new())?;
    found.files.sort_by_key(|path| path.ends_with(IDENTITY));
    for path in found.files {
        gone(fs::remove_file(path))?;
    }
    for path in found.folders {
        match fs::remove_dir(&path) {
            // What is not a run's is in it; a link is not a run's either.
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::DirectoryNotEmpty | ErrorKind::NotADirectory
                ) =>
            {
                found.foreign.get_or_insert(path);
            }
            removed => gone(removed)?,
        }
    }
    Ok(found.foreign)
}

/// What is not there any more is removed.
pub fn gone(removed: io::Result<()>) -> io::Result<()> {
    match removed {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, name: &str) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, name).unwrap();
    }

    const OWN: [&str; 11] = [
        "zarr.json",
        "samples.f64",
        "identity.json",
        "report.json",
        "zeta/zarr.json",
        "zeta/c/0/12",
        "omega/c/0",
        "level/c/0",
        "cell/c/0",
        "lists-177x177/round-00001",
        ".topple-zeta-c-0-0.aB3xY9.part",
    ];

    #[test]
    fn a_folder_of_a_run_goes_whole() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("unfinished");
        OWN.iter().for_each(|name| write(&folder, name));
        assert_eq!(foreign(&folder, Kind::Group).unwrap(), None);
        assert_eq!(remove(&folder, Kind::Group).unwrap(), None);
        assert!(!folder.exists());
        assert_eq!(remove(&folder, Kind::Group).unwrap(), None);
    }

    #[test]
    fn what_no_run_wrote_stays_and_is_told() {
        for mine in [
            "thesis",
            "zeta/notes.txt",
            "zeta/c/0/notes",
            "mine/zarr.json",
            "zarr.json.orig",
            "lists/round-00000",
            "lists-177x177/mine",
            "c/0/0",
            ".topple-thesis.backup",
            ".topple-mine/x",
        ] {
            let place = tempfile::tempdir().unwrap();
            let folder = place.path().join("unfinished");
            OWN.iter().chain([&mine]).for_each(|name| write(&folder, name));
            assert!(foreign(&folder, Kind::Group).unwrap().is_some(), "{mine}");
            assert!(remove(&folder, Kind::Group).unwrap().is_some(), "{mine}");
            assert_eq!(fs::read_to_string(folder.join(mine)).unwrap(), mine);
            assert!(OWN.iter().all(|name| !folder.join(name).exists()), "{mine}");
        }
    }

    #[test]
    fn the_names_of_one_kind_are_not_those_of_another() {
        let place = tempfile::tempdir().unwrap();
        let motion = "0123456789abcdef".repeat(4);
        write(place.path(), &motion);
        assert_eq!(foreign(place.path(), Kind::Motions).unwrap(), None);
        for kind in [Kind::Group, Kind::Empty] {
            assert!(foreign(place.path(), kind).unwrap().is_some());
        }
        for other in [&motion[1..], &motion.to_uppercase(), "zarr.json"] {
            assert!(!is_motion(other), "{other}");
        }
    }
}
