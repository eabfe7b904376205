//! The `topple` command as a function, for its program and for tests of it.

#![warn(clippy::print_stdout, clippy::print_stderr)] // a closed pipe is no failure

mod adapters;
mod bench;
pub mod beside;
mod call;
mod chart;
mod compare;
mod completions;
pub mod date;
mod device_remarks;
mod disk;
#[doc(hidden)] // for the test of damaged files
pub mod earlier_run;
mod envelope;
mod errors;
mod estimate;
mod examples;
mod explore;
mod figures;
mod finish;
mod fragility;
mod given;
mod history;
mod history_table;
mod inputs;
mod interrupt;
mod licences;
mod load;
mod manifest;
mod map_file;
mod map_files;
mod memory;
mod merge;
mod numbers;
mod options;
mod picture_flags;
mod print;
mod probability;
pub mod progress;
mod pulse;
mod ratios;
mod record;
mod refined;
mod repetition;
mod report;
mod results_directory;
mod run;
mod save;
mod scene;
mod seismic;
mod study;
mod study_flags;
mod study_words;
mod suite;
mod template;
mod uncertain;
pub mod words;
mod written;

use std::ffi::OsString;

use call::Call;
pub use call::Streams;
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};
use errors::Interrupted;
use interrupt::STATUS as INTERRUPTED;
use print::error_line;

/// Bad input, in one line: what is wrong, where, and what to do. Exit status 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct InputError(pub String);

/// The commit from which the program was built: of a release build in a checkout.
const COMMIT: Option<&str> = option_env!("TOPPLE_COMMIT");

/// The version, and the commit in brackets.
fn version() -> String {
    let commit = COMMIT.map(|commit| format!(" ({commit})")).unwrap_or_default();
    format!("{}{commit}", env!("CARGO_PKG_VERSION"))
}

/// Overturning and rocking maps of rigid blocks on an isolated base.
///
/// Without a command, runs the default scene into ./topple-out.
#[derive(Parser)]
#[command(name = "topple", version = version(), args_conflicts_with_subcommands = true, after_help = examples::TOPPLE)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    options: options::MapOptions,
}

#[derive(Subcommand)]
enum Command {
    /// Map the outcomes of pulses over any of their numbers, for example (omega, a_h)
    Pulse(pulse::PulseCommand),
    /// Map the response to a ground-motion record, for example over (t_h, t_v)
    Seismic(seismic::SeismicCommand),
    /// Read a set of records as one suite: pair the components, compute intensity measures
    Suite(suite::SuiteCommand),
    #[command(flatten)]
    Study(Studies),
    /// Write a report of runs for those who decide, as HTML or PDF
    Report(report::ReportCommand),
    /// Join the shards of a map made with --tile
    Merge(merge::MergeCommand),
    /// Compute the motion of one cell; every number has a single value
    History(history::HistoryCommand),
    /// Run a scene from a file, or repeat an earlier run
    Run(scene::RunCommand),
    /// Show a map that follows sliders, on a page in the browser
    Explore(explore::ExploreCommand),
    /// Draw charts of speed against accuracy for several methods, steps and tolerances
    Chart(chart::ChartCommand),
    /// Draw the figures of the paper, and further ones
    Figures(figures::FiguresCommand),
    /// Measure every backend of this machine on the same maps, and print the table
    Bench(bench::BenchCommand),
    /// Print a scene file to start from, with every key
    Scene,
    /// List the GPU adapters of this machine
    Adapters,
    /// Print the completions of a shell
    Completions(completions::CompletionsCommand),
    /// Print the manual page of topple or of one of its commands
    Man(completions::ManCommand),
    /// Print the licences of topple and of the font of its pictures
    Licences,
}

/// The studies, a command each.
#[derive(clap::Subcommand)]
enum Studies {
    /// Sweep a scene under every motion of a suite: find the cells in which the block stands within given strokes
    Envelope(Box<study::StudyCommand<envelope::EnvelopeFlags>>),
    /// Estimate how likely the block overturns under a suite, by the intensity of the motions
    Fragility(Box<study::StudyCommand<fragility::FragilityFlags>>),
    /// Compare the devices of a list under every motion of a suite: shares, strokes, reserves, annual rates
    Compare(Box<study::StudyCommand<compare::CompareFlags>>),
}

impl Studies {
    /// The one that is given.
    fn command(self) -> Box<dyn study::AnyStudy> {
        match self {
            Studies::Envelope(command) => command,
            Studies::Fragility(command) => command,
            Studies::Compare(command) => command,
        }
    }
}

/// The grammar of its command lines.
pub fn arguments() -> clap::Command {
    Arguments::command()
}

/// Parses the words of a command line, the program's name first, and does what they say.
fn parse_and_do(words: &[OsString]) -> anyhow::Result<()> {
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) if error.use_stderr() => return Err(InputError(one_line(&error, words)).into()),
        Err(help) => {
            print::text(help.render().ansi());
            return print::end().map_err(anyhow::Error::msg);
        }
    };
    let done = match arguments.command {
        Some(Command::Pulse(command)) => command.run(),
        Some(Command::Seismic(command)) => command.run(),
        Some(Command::Suite(command)) => command.run(),
        Some(Command::Study(study)) => study.command().run(),
        Some(Command::Report(command)) => command.run(),
        Some(Command::Merge(command)) => command.run(),
        Some(Command::History(command)) => command.run(),
        Some(Command::Run(command)) => command.run(),
        Some(Command::Explore(command)) => command.run(),
        Some(Command::Chart(command)) => command.run(),
        Some(Command::Figures(command)) => command.run(),
        Some(Command::Bench(command)) => command.run(),
        Some(Command::Scene) => {
            template::run();
            Ok(())
        }
        Some(Command::Adapters) => adapters::run(),
        Some(Command::Completions(command)) => command.run(),
        Some(Command::Man(command)) => command.run(),
        Some(Command::Licences) => {
            licences::run();
            Ok(())
        }
        None => scene::run_default(&arguments.options),
    };
    done?;
    // Files are what a run is for; what it says is lost all the same.
    print::end().map_err(anyhow::Error::msg)
}

/// A parser's message on one line, without its usage.
fn one_line(error: &clap::Error, words: &[OsString]) -> String {
    if error.kind() == ErrorKind::InvalidUtf8 {
        let wrong = words.iter().skip(1).filter(|word| word.to_str().is_none());
        let wrong: Vec<String> = wrong.map(|word| format!("'{}'", word.display())).collect();
        return format!("{}: no text in UTF-8; give words in UTF-8", wrong.join(", "));
    }
    let text = error.render().to_string();
    let said = text.split("Usage:").next().unwrap_or_default();
    let said = said.split("For more information").next().unwrap_or_default();
    let said: Vec<&str> = said.split_whitespace().collect();
    let line = said.join(" ").replace(" tip: ", "; ");
    let line = line.strip_prefix("error: ").unwrap_or(&line);
    let first = words.get(1).and_then(|word| word.to_str());
    let command = first.filter(|name| arguments().find_subcommand(name).is_some());
    let command = command.map(|name| format!(" {name}")).unwrap_or_default();
    format!("{line}; see topple{command} --help")
}

/// Runs a command line, the program's name first. Exit status: 0 done; 1 a run that failed; 2 bad input; 130 ended by
/// Ctrl-C.
pub fn run(words: impl IntoIterator<Item = OsString>, streams: Streams) -> u8 {
    let words: Vec<OsString> = words.into_iter().collect();
    Call::of(&words, streams).scope(|| match parse_and_do(&words) {
        Ok(()) => 0,
        Err(error) => {
            error_line(format_args!("{error:#}"));
            match &error {
                error if error.is::<InputError>() => 2,
                error if error.is::<Interrupted>() => INTERRUPTED,
                _ => 1,
            }
        }
    })
}
