//! `topple report`.

use std::path::PathBuf;

use topple_report::ReportError;

use super::picture_flags;
use super::words::{self, Reporter, counted};
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
    /// Title of the report, in the place of that of its runs
    #[arg(long, value_name = "TEXT", value_parser = picture_flags::title)]
    title: Option<String>,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
}

/// What is wrong with a run, or with the report's name, is bad input; a picture that cannot be drawn is a failure.
fn failed(error: ReportError) -> anyhow::Error {
    match error {
        ReportError::Figure(_) | ReportError::Write(_) => error.into(),
        ReportError::Place(problem) => InputError(format!("--out: {problem}")).into(),
        error => InputError(error.to_string()).into(),
    }
}

impl ReportCommand {
    /// Reads the runs and writes the report.
    pub fn run(&self) -> anyhow::Result<()> {
        let written = topple_report::write(&self.folders, &self.out, self.title.as_deref());
        words::warn_of_letters(written.map_err(failed)?);
        let of = counted(self.folders.len(), "run");
        Reporter::unless(self.quiet).line("report", format!("{} of {of}", self.out.display()));
        Ok(())
    }
}
