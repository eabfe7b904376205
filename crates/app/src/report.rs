//! `topple report`.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use topple::results::files::Directory;
use topple_report::{Folder, ReportError, html, print};

use super::suite::counted;
use super::words::Reporter;
use super::{InputError, examples};

/// Write a report of one or several runs for those who decide, as one HTML file or a PDF.
#[derive(clap::Args)]
#[command(after_help = examples::REPORT)]
pub struct ReportCommand {
    /// Directories of results, written by commands of topple with --out
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// File of the report; its name ends with .html or .pdf
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
}

/// What a report is written as.
#[derive(Clone, Copy)]
enum Format {
    Html,
    Pdf,
}

/// Where in a report its mark is: within so many bytes from the start.
const HEAD: u64 = 4096;

impl Format {
    fn of(path: &Path) -> Result<Format, InputError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "html" => Ok(Format::Html),
            "pdf" => Ok(Format::Pdf),
            _ => {
                let place = path.display();
                let problem = "a report is .html or .pdf; give a name with one of these endings";
                Err(InputError(format!("--out: {place}: {problem}")))
            }
        }
    }

    /// Refuses a file, or anything else, in the report's place that no report is.
    fn refuse_foreign(self, path: &Path) -> Result<(), InputError> {
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
        Err(InputError(format!("--out: {} {problem}", path.display())))
    }
}

/// What is wrong with a run is bad input; a picture that cannot be drawn is a failure.
fn failed(error: ReportError) -> anyhow::Error {
    match error {
        ReportError::Figure(error) => error.into(),
        error => InputError(error.to_string()).into(),
    }
}

impl ReportCommand {
    /// Reads the runs and writes the report.
    pub fn run(&self) -> anyhow::Result<()> {
        let format = Format::of(&self.out)?;
        let unnamed = || InputError(format!("--out: {} is no name of a file", self.out.display()));
        let name = self.out.file_name().and_then(|name| name.to_str()).ok_or_else(unnamed)?;
        format.refuse_foreign(&self.out)?;
        let folders = self.folders.iter().map(|path| Folder::read(path));
        let folders = folders.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let document = topple_report::of(&folders).map_err(failed)?;
        let bytes = match format {
            Format::Html => html::write(&document).into_bytes(),
            Format::Pdf => print::write(&document)?,
        };
        let place = self.out.parent().filter(|folder| !folder.as_os_str().is_empty());
        let place = Directory::open(place.unwrap_or(Path::new(".")));
        let place = place.map_err(|error| InputError(format!("--out: {error}")))?;
        place.write(name, |w| w.write_all(&bytes))?;
        let of = counted(folders.len(), "run");
        Reporter::unless(self.quiet).line("report", format!("{} of {of}", self.out.display()));
        Ok(())
    }
}
