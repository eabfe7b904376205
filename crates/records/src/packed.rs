//! Packed files: a gzip file, or the only file of a zip.

use std::borrow::Cow;
use std::io::{Cursor, ErrorKind, Read};

use flate2::read::MultiGzDecoder;
use zip::ZipArchive;
use zip::result::ZipError;

use super::shown::{self, shown};
use super::{RecordError, bounded, other_programs, zips};

/// The bytes of a file: of a gzip file what is packed, of a zip its one file. Says what it had to decide. `most` bytes are
/// read, packed or not.
///
/// # Errors
/// A damaged file, one that is too large, and a zip of several files.
pub fn unpacked(bytes: &[u8], most: u64) -> Result<(Cow<'_, [u8]>, Option<String>), RecordError> {
    if bytes.len() as u64 > most {
        return Err(RecordError::Large { most });
    }
    let (unpacked, note) = match bytes {
        bytes if bytes.starts_with(&GZIP) => {
            (gunzipped(bytes, most)?, Some("unpacked from gzip".into()))
        }
        [b'P', b'K', 3, 4, ..] => {
            let (bytes, name) = only_file(bytes, most)?;
            let bytes = if bytes.starts_with(&GZIP) { gunzipped(&bytes, most)? } else { bytes };
            (bytes, Some(format!("{} from a zip", shown(&name))))
        }
        _ => return Ok((bytes.into(), None)),
    };
    Ok((unpacked.into(), note))
}

/// How a gzip file begins.
const GZIP: [u8; 2] = [0x1f, 0x8b];

fn gunzipped(bytes: &[u8], most: u64) -> Result<Vec<u8>, RecordError> {
    all(MultiGzDecoder::new(bytes), most, "gzip")
}

/// All bytes of a packed stream.
fn all(packed: impl Read, most: u64, kind: &str) -> Result<Vec<u8>, RecordError> {
    bounded::all(packed, most).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => RecordError::Large { most },
        _ => RecordError::whole(format!("a damaged {kind} file ({error}); download it again")),
    })
}

/// The bytes and the name of the only file in a zip.
fn only_file(bytes: &[u8], most: u64) -> Result<(Vec<u8>, String), RecordError> {
    let damaged = |error| {
        RecordError::whole(match error {
            ZipError::UnsupportedArchive(reason) => {
                format!("a zip that is not read here ({reason}); unpack it and give the file")
            }
            error if error.to_string().contains("not supported") => {
                format!("a zip that is not read here ({error}); unpack it and give the file")
            }
            error => {
                let error = shown::line(&error.to_string());
                format!("a damaged zip file ({error}); download it again")
            }
        })
    };
    zips::check(bytes).map_err(|error| {
        RecordError::whole(format!("a zip of {error}; unpack it and give the file"))
    })?;
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(damaged)?;
    let names = files(&archive).map_err(damaged)?;
    if let Some(problem) = other_programs::of_zip(&names) {
        return Err(RecordError::whole(problem));
    }
    let [name] = &names[..] else {
        let mut first: Vec<String> = names.iter().take(3).map(|name| shown(name)).collect();
        if names.len() > first.len() {
            first.push("…".into());
        }
        let problem = match names.len() {
            0 => "a zip without files".into(),
            count => {
                format!("a zip of {count} files ({}); unpack it and give one", first.join(", "))
            }
        };
        return Err(RecordError::whole(problem));
    };
    let file = archive.by_name(name).map_err(damaged)?;
    Ok((all(file, most, "zip")?, name.clone()))
}

/// The names of the files in a zip.
fn files(archive: &ZipArchive<Cursor<&[u8]>>) -> Result<Vec<String>, ZipError> {
    let mut names = Vec::new();
    for name in archive.file_names() {
        let name = name?;
        // A Mac packs what it knows of a file beside it.
        let is_hidden = name.rsplit('/').next().is_some_and(|file| file.starts_with('.'));
        if !name.ends_with('/') && !name.starts_with("__MACOSX/") && !is_hidden {
            names.push(name.into_owned());
        }
    }
    Ok(names)
}

/// What a zip is that is a file of another program, and what to do with it.
pub(super) fn of_program(bytes: &[u8]) -> Option<&'static str> {
    if !bytes.starts_with(b"PK\x03\x04") || zips::check(bytes).is_err() {
        return None;
    }
    let archive = ZipArchive::new(Cursor::new(bytes)).ok()?;
    other_programs::of_zip(&files(&archive).ok()?)
}
