//! A run under a suite that is repeated by the command line in its run.json.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;
use topple::results::earlier::{Kind, RUN};
use topple::scene::path_text::PathText;
use topple_manifest::{CommandLine, Manifest, Study};

use super::options::MapOptions;
use super::study::{StudyCommand, StudyFlags};
use super::suite_run::Repeats;
use super::{Arguments, Command, InputError};

/// A run that is repeated: its command, and what its relative paths are looked for in.
pub struct Repeated {
    /// What is run.
    pub command: Command,
    /// The words that say so, and the files that it read.
    repeats: Repeats,
    /// Where the results lie.
    folder: PathBuf,
}

/// The run of a directory of results under a suite, or of its run.json; none of other results.
///
/// # Errors
/// What is wrong with it.
pub fn at(path: &Path) -> Option<Result<Repeated, String>> {
    let ends_in =
        |ending: &str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    let file = match path.is_dir() {
        true => path.join(RUN),
        // A table has it beside itself.
        false if ends_in("csv") => path.with_file_name(RUN),
        false if ends_in("json") => path.to_path_buf(),
        false => return None,
    };
    let Manifest { kind, run, .. } = Manifest::read(&file).ok()?;
    let Study { command, records, .. } = run.study()?.clone();
    let (line, inputs) = (command?, run.inputs().cloned().unwrap_or_default());
    let words = line.arguments.iter().map(|PathText(word)| OsString::from(word));
    let parsed = Arguments::try_parse_from([OsString::from("topple")].into_iter().chain(words));
    let other = || Err(format!("its command is not one of {}; give a scene", kind.name()));
    let command = match parsed {
        Ok(Arguments { command: Some(command), .. }) if kind_of(&command) == Some(kind) => command,
        _ => return Some(other()),
    };
    let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
    Some(Ok(Repeated { command, repeats: Repeats { line, records, inputs }, folder }))
}

/// What a command under a suite makes; none of another command.
fn kind_of(command: &Command) -> Option<Kind> {
    match command {
        Command::Envelope(_) => Some(Kind::Envelope),
        Command::Fragility(_) => Some(Kind::Fragility),
        Command::Compare(_) => Some(Kind::Comparison),
        _ => None,
    }
}

impl Repeated {
    /// Runs it with the directory, the threads and the silence of `options`, which may have no other flag.
    pub fn run(self, options: &MapOptions) -> anyhow::Result<()> {
        if let Some(flag) = options.not_of_a_repetition().first() {
            let problem = format!(
                "{flag}: a run under a suite is repeated as it was; leave it out, or give the whole command"
            );
            return Err(InputError(problem).into());
        }
        let Repeated { command, repeats, folder } = self;
        match command {
            Command::Envelope(command) => again(*command, repeats, &folder, options),
            Command::Fragility(command) => again(*command, repeats, &folder, options),
            Command::Compare(command) => again(*command, repeats, &folder, options),
            _ => Ok(()),
        }
    }
}

/// Runs a study again; the files that it reads are looked for.
fn again<Own: StudyFlags>(
    mut command: StudyCommand<Own>,
    repeats: Repeats,
    folder: &Path,
    options: &MapOptions,
) -> anyhow::Result<()> {
    let StudyCommand { motions, own, options: run, .. } = &mut command;
    for (flag, path) in own.files() {
        *path = found(flag, path, &repeats.line, folder)?;
    }
    let suite = found("--suite", motions.suite(), &repeats.line, folder)?;
    motions.repeat(suite, repeats);
    run.out.clone_from(&options.run.out);
    run.quiet |= options.run.quiet;
    run.threads = options.run.threads.or(run.threads);
    command.run()
}

/// A path of a run: where it was, beside the results, or in the working directory.
fn found(
    flag: &str,
    path: &Path,
    line: &CommandLine,
    folder: &Path,
) -> Result<PathBuf, InputError> {
    let PathText(directory) = &line.directory;
    let places = [directory.join(path), folder.join(path), path.to_path_buf()];
    places.into_iter().find(|place| place.exists()).ok_or_else(|| {
        let problem = format!(
            "{flag}: {} is neither in {} nor beside the results; put it there",
            path.display(),
            directory.display()
        );
        InputError(problem)
    })
}
