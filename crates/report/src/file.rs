//! A report as a file: runs in, one HTML file or PDF out.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use topple::results::files::Directory;
use topple_pictures::drawing::letters::Missing;

use super::{Folder, ReportError, contents, html, print};

/// What a report is written as.
#[derive(Clone, Copy)]
enum Format {
    Html,
    Pdf,
}

/// Where in a report its mark is: within so many bytes from the start.
const HEAD: u64 = 4096;

impl Format {
    fn of(path: &Path) -> Result<Format, ReportError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "html" => Ok(Format::Html),
            "pdf" => Ok(Format::Pdf),
            _ => {
                let problem = "a report is .html or .pdf; give a name with one of these endings";
                Err(ReportError::Place(format!("{}: {problem}", path.display())))
            }
        }
    }

    /// Refuses a file, or anything else, in the report's place that no report is.
    fn refuse_foreign(self, path: &Path) -> Result<(), ReportError> {
        let Ok(there) = path.symlink_metadata() else { return Ok(()) };
        let mark = match self {
            Format::Html => html::mark(),
            Format::Pdf => print::mark(),
        };
        let mut head = Vec::new();
        let is_report = there.is_file()
            && File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head)).is_ok()
            && head.windows(mark.len()).any(|part| part == mark.as_bytes());
        if is_report {
            return Ok(());
        }
        let problem = "is there already and is no report of topple; give another name, or move it";
        Err(ReportError::Place(format!("{} {problem}", path.display())))
    }
}

/// Reads runs and writes their report, as HTML or as a PDF by the ending of its name; under a title of the runs where none
/// is given. What is not as it should be in it, such as letters that no font has, is returned.
///
/// # Errors
/// [`ReportError`], with no report written.
pub fn write(
    runs: &[PathBuf],
    out: &Path,
    title: Option<&str>,
) -> Result<Option<Missing>, ReportError> {
    let format = Format::of(out)?;
    let unnamed = || ReportError::Place(format!("{} is no name of a file", out.display()));
    let name = out.file_name().and_then(|name| name.to_str()).ok_or_else(unnamed)?;
    format.refuse_foreign(out)?;
    let folders = runs.iter().map(|path| Folder::read(path)).collect::<Result<Vec<_>, _>>()?;
    let document = contents::of(&folders, title)?;
    let (bytes, problem) = match format {
        // A browser has fonts of its own.
        Format::Html => (html::write(&document).into_bytes(), None),
        Format::Pdf => print::write(&document)?,
    };
    let place = out.parent().filter(|folder| !folder.as_os_str().is_empty());
    let place = Directory::open(place.unwrap_or(Path::new(".")))
        .map_err(|error| ReportError::Place(error.to_string()))?;
    place.write(name, |w| w.write_all(&bytes))?;
    Ok(problem)
}
