//! From the bytes of a file to its text: packed files are unpacked, other encodings turned into UTF-8.

use std::io::{Cursor, ErrorKind, Read};

use flate2::read::MultiGzDecoder;
use zip::ZipArchive;
use zip::result::ZipError;

use super::{RecordError, plain, zips};
use crate::scene::bounded;
use crate::scene::shown::{self, shown};

/// Largest file that is read, bytes; of a packed one also what is in it.
pub(crate) const LARGEST: u64 = 256 << 20;
/// A file that is smaller, packed or not, may be read beside others: more of them at once would fill the memory.
pub(crate) const SMALL: u64 = 8 << 20;
/// Most bytes of a line: its fields are held together, and a record's lines are short.
const LONGEST_LINE: usize = 1 << 24;

/// The text of a file: of a gzip file what is packed, of a zip its one file; in UTF-8, UTF-16, or else
/// Latin-1. Says what it had to decide. `most` bytes are read, packed or not.
///
/// # Errors
/// What it is, where it is no record, and what to do.
pub(crate) fn of(bytes: &[u8], most: u64) -> Result<(String, Option<String>), RecordError> {
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
        _ => return Ok((decoded(bytes)?, None)),
    };
    Ok((decoded(&unpacked)?, note))
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
    let mut names = Vec::new();
    for name in archive.file_names() {
        let name = name.map_err(damaged)?;
        // A Mac packs what it knows of a file beside it.
        let is_hidden = name.rsplit('/').next().is_some_and(|file| file.starts_with('.'));
        if !name.ends_with('/') && !name.starts_with("__MACOSX/") && !is_hidden {
            names.push(name.into_owned());
        }
    }
    if names.iter().any(|name| name == "xl/workbook.xml") {
        let problem = "a spreadsheet (.xlsx); save its sheet as CSV and give that";
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

/// Bytes as text, its lines ended as here.
///
/// # Errors
/// What it is, where it is no text, and what to do.
pub fn decoded(bytes: &[u8]) -> Result<String, RecordError> {
    let text = plain::of(bytes);
    let start: String = text.trim_start().chars().take(64).collect();
    let start = start.to_ascii_lowercase();
    if ["<!doctype html", "<html", "<?xml", "<head", "<body"]
        .iter()
        .any(|tag| start.starts_with(tag))
    {
        let problem = "a web page, not a record: perhaps what a site shows in place of the file \
                       (a login); download the file itself";
        return Err(RecordError::whole(problem));
    }
    if bytes.starts_with(b"%PDF") {
        return Err(RecordError::whole("a PDF, not a record; give the file of numbers"));
    }
    if let Some(problem) = plain::other_program(bytes) {
        return Err(RecordError::whole(problem));
    }
    if text.chars().take(1024).any(|c| c == '\0') {
        return Err(RecordError::whole("a binary file, not a record; give a file of numbers"));
    }
    let long = text.lines().position(|line| line.len() > LONGEST_LINE);
    if let Some(before) = long {
        let most = bounded::size(LONGEST_LINE as u64);
        let problem = format!("longer than {most}; give the record with a few values a line");
        return Err(RecordError::line(before + 1, problem));
    }
    Ok(text)
}

/// A text without control characters, which a terminal would obey and an SVG may not hold.
pub(crate) fn printable(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    use super::*;

    fn zipped(files: &[(&str, &str)]) -> Vec<u8> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in files {
            archive.start_file(*name, SimpleFileOptions::default()).unwrap();
            archive.write_all(text.as_bytes()).unwrap();
        }
        archive.finish().unwrap().into_inner()
    }

    #[test]
    fn packed_files_are_unpacked() {
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(b"1\n2\n").unwrap();
        let packed = packed.finish().unwrap();
        assert_eq!(
            of(&packed, LARGEST).unwrap(),
            ("1\n2\n".into(), Some("unpacked from gzip".into()))
        );
        for cut in 2..packed.len() {
            assert!(of(&packed[..cut], LARGEST).is_err(), "cut to {cut}");
        }
        let one = zipped(&[("dir/", ""), ("dir/a.at2", "1\n")]);
        assert_eq!(of(&one, LARGEST).unwrap(), ("1\n".into(), Some("dir/a.at2 from a zip".into())));
        let two = of(&zipped(&[("a.at2", "1"), ("b.at2", "2")]), LARGEST).unwrap_err().to_string();
        assert!(two.contains("a zip of 2 files (a.at2, b.at2); unpack it"), "{two}");
        assert!(of(&one[..one.len() - 9], LARGEST).is_err());
    }

    /// Of a gzip file that says so a thousandth lies on disk, and what a zip declares is not believed.
    #[test]
    fn what_is_packed_is_read_up_to_a_size() {
        let large = vec![b'1'; 3000];
        let mut gzip = GzEncoder::new(Vec::new(), Compression::fast());
        gzip.write_all(&large).unwrap();
        let gzip = gzip.finish().unwrap();
        let mut zip = zipped(&[("a.at2", &"1".repeat(3000))]);
        let plain = (b"1\n".repeat(1500), "1\n".repeat(1500));
        assert!(gzip.len() < 200 && of(&gzip, 3000).is_ok() && of(&zip, 3000).is_ok());
        assert_eq!(of(&plain.0, 3000).unwrap().0, plain.1);
        // The size in the directory, at 24 bytes from its beginning, is said to be 5.
        let directory = zip.windows(4).position(|bytes| bytes == b"PK\x01\x02").unwrap();
        for packed in [&gzip, &zip, &plain.0] {
            assert_eq!(of(packed, 2999), Err(RecordError::Large { most: 2999 }));
        }
        zip[directory + 24..directory + 28].copy_from_slice(&5_u32.to_le_bytes());
        assert!(of(&zip, 2999).is_err());
    }

    #[test]
    fn a_line_without_an_end_is_refused() {
        let long = [b"1\n", &vec![b'1'; LONGEST_LINE + 1][..]].concat();
        let error = of(&long, LARGEST).unwrap_err().to_string();
        assert_eq!(error, "line 2: longer than 16 MiB; give the record with a few values a line");
    }

    #[test]
    fn other_encodings_are_read() {
        let text = "\u{feff}Erdbeben ä\n1\n";
        let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
        assert_eq!(read, "Erdbeben ä\n1\n");
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = text.encode_utf16().flat_map(order).collect();
            assert_eq!(of(&bytes, LARGEST).unwrap().0, "Erdbeben ä\n1\n");
        }
    }

    #[test]
    fn lines_end_however_systems_end_them() {
        for text in [
            "1\r2\r3",
            "1\r\n2\r\n3",
            "1\r\r\n2\r\r\n3\r\r\n",
            "1\n2\n3\n\x1a",
            "1\n2\r\n3\r\n\x1a\x1a\0\0",
            "\u{feff}\u{feff}1\n2\n3",
        ] {
            let (read, _) = of(text.as_bytes(), LARGEST).unwrap();
            assert_eq!(read.lines().collect::<Vec<_>>(), ["1", "2", "3"], "{text:?}");
        }
        // Amid a text it ends nothing.
        assert!(of(b"1\n\x1a2\n", LARGEST).unwrap().0.contains('\x1a'));
        let wide: Vec<u8> =
            "0.123456 0.234567\n0.3".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(of(&wide, LARGEST).unwrap().0, "0.123456 0.234567\n0.3");
    }

    #[test]
    fn what_is_no_record_is_named() {
        let xlsx = zipped(&[("xl/workbook.xml", ""), ("xl/a.xml", "")]);
        let mut sac = vec![0_u8; 700];
        sac[4 * 76] = 6;
        let mut seed = b"000001D XXX  HNE".to_vec();
        seed.resize(512, 0);
        for (bytes, said) in [(&xlsx, "save its sheet as CSV"), (&sac, "SAC"), (&seed, "miniSEED")]
        {
            let error = of(bytes, LARGEST).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        for (bytes, said) in [
            (&b"  <!DOCTYPE html><html>"[..], "a web page"),
            (b"<html><body>Login", "a web page"),
            (b"%PDF-1.7", "a PDF"),
            (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a binary file"),
        ] {
            let error = of(bytes, LARGEST).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        assert_eq!(printable("a\u{1b}[31mb\u{7}"), "a[31mb");
    }
}
