//! A run under a suite that is repeated by the command line in its run.json.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;
use topple::results::earlier::RUN;
use topple::scene::path_text::PathText;
use topple_manifest::{CommandLine, Manifest, Study};

use super::given::GivenFlags;
use super::inputs::Repeats;
use super::options::MapOptions;
use super::study::AnyStudy;
use super::{Arguments, Command, InputError};

/// Runs again what the directory of a study's results tells, or its run.json, or a table beside it, with the directory, the threads
/// and the silence of `options`, which may have no other flag; none of other results.
pub fn run(path: &Path, options: &MapOptions, given: &GivenFlags) -> Option<anyhow::Result<()>> {
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
    let folder = file.parent().unwrap_or(Path::new(""));
    let command = match parsed.ok().and_then(|parsed| parsed.command) {
        Some(Command::Study(study)) => Some(study.command()).filter(|own| own.kind() == kind),
        _ => None,
    };
    let Some(command) = command else {
        let problem = format!("its command is not one of {}; give a scene", kind.name());
        return Some(Err(InputError(format!("{}: {problem}", path.display())).into()));
    };
    Some(again(command, (Repeats { line, records, inputs }, folder), options, given))
}

/// Runs a study again, as a whole and from the start; the files that it reads are looked for.
fn again(
    mut command: Box<dyn AnyStudy>,
    (repeats, folder): (Repeats, &Path),
    options: &MapOptions,
    given: &GivenFlags,
) -> anyhow::Result<()> {
    let kept = ["out", "quiet", "verbose", "threads"];
    if let Some(flag) = given.find(|name| !kept.contains(&name)) {
        let problem = format!(
            "{flag}: a run under a suite is repeated as it was; leave it out, or give the whole command"
        );
        return Err(InputError(problem).into());
    }
    let (files, motions, run) = command.parts();
    let suite = ("--suite", &mut motions.suite);
    for (flag, path) in files.into_iter().chain([suite]) {
        *path = found(flag, path, &repeats.line, folder)?;
    }
    motions.repeats = Some(repeats);
    (motions.resume, motions.tile, motions.dry_run) = (false, None, false);
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
