//! `topple suite`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use topple::backend::ready::Backend;
use topple::backend::report::threads;
use topple::model::precision::Precision;
use topple::results::earlier::Kind;
use topple::scene::path_text::PathText;
use topple::scene::record::Baseline;
use topple::scene::shown;
use topple_manifest::{Run, Source, SuiteRun};
use topple_pictures::studies::suite as picture;
use topple_studies::suites::read::Reading;
use topple_studies::suites::{Suite, SuiteError, table};

use super::call::Call;
use super::picture_flags::PictureFlags;
use super::results_directory::Place;
use super::words::{self, Reporter, counted, with_columns};
use super::written::one_of;
use super::{InputError, examples};

/// Read a folder, a zip or a list of records as one suite, and write a table of its motions.
///
/// Each horizontal component is paired with the vertical component of its station. If a component is missing or ambiguous,
/// its row of the table has no numbers and says why.
#[derive(clap::Args)]
#[command(after_help = examples::SUITE)]
pub struct SuiteCommand {
    /// Folder or zip of records, or a list (CSV) in the folder of the records
    #[arg(value_name = "PATH")]
    path: PathBuf,
    /// Directory for the results; created if it does not exist
    #[arg(short, long, value_name = "DIR", default_value = "topple-out")]
    out: PathBuf,
    /// Refuse a suite in which a file is missing, ambiguous or unused
    #[arg(long)]
    strict: bool,
    /// What to subtract from the velocities of all components whose list says nothing of it, as for topple seismic [default: none]
    #[arg(long, value_name = "none|line", value_parser = one_of::<Baseline>())]
    baseline: Option<Baseline>,
    /// Print only warnings and errors
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    pictures: PictureFlags,
}

/// Most reasons that are printed one by one.
const SHOWN: usize = 10;

impl SuiteCommand {
    /// Reads the suite and writes its table.
    pub fn run(&self) -> anyhow::Result<()> {
        let print = self.pictures.print().map_err(InputError)?;
        let reading = Reading { strict: self.strict, baseline: self.baseline };
        let suite = Suite::read_as(&self.path, reading).map_err(input_error)?;
        let place = Place::of(&self.out, Kind::Suite)?;
        let say = Reporter::unless(self.quiet);
        let files = ["suite.csv", "suite.svg", "suite.png"];
        place.refuse_foreign(&files.map(String::from))?;
        let mut out = place.open_alone()?;
        let drawn = picture::draw(&suite, print);
        let png = drawn.png()?;
        out.begin(files.map(String::from).to_vec(), &say)?;
        out.write(files[0], |w| table::suite(&suite).write(w))?;
        out.picture("suite", &drawn, &png)?;
        warn_of_doubts(&suite);
        out.finish(Run::Suite(Box::new(SuiteRun {
            suite: Some(PathText(self.path.clone())),
            command: Some(Call::current().command_line()),
            motions: suite.motions().count(),
            recordings: Some(suite.recordings().1),
            events: suite.events(),
            records: Source::of(&suite),
            left_out: left_out(&suite),
            unused: suite.unused.iter().map(|one| (one.file.clone(), one.why.clone())).collect(),
            backend: Some(Backend::Cpu.name().into()),
            adapter: None,
            threads: threads(),
            precision: Some(Precision::F64),
            pictures: self.pictures.record(),
        })))?;
        tell(&suite, &say);
        say.line("picture", out.file(files[2]).display());
        say.line("table", format!("{} with run.json", out.file(files[0]).display()));
        Ok(())
    }
}

/// Why lines of a suite have no motion, by their ids.
pub fn left_out(suite: &Suite) -> BTreeMap<String, String> {
    suite.left_out().map(|(entry, why)| (entry.id.clone(), why.into())).collect()
}

/// Warns of lists that may be wrong, and of motions whose samples may be, the first of each kind with what it is.
fn warn_of_doubts(suite: &Suite) {
    suite.doubts.iter().for_each(words::warn);
    let doubtful: Vec<_> =
        suite.motions().filter(|(_, motion)| !motion.pair.doubts.is_empty()).collect();
    if let Some((entry, motion)) = doubtful.first() {
        let doubts: Vec<String> =
            motion.pair.doubts.iter().map(|doubt| words::with_flags(doubt)).collect();
        words::warn(format!(
            "{} may have wrong samples, of which the first is {}: {}",
            counted(doubtful.len(), "motion"),
            entry.id,
            doubts.join("; ")
        ));
    }
}

/// Says how many motions a suite has, and warns of lines that have none, and of motions that may be wrong.
pub fn count(suite: &Suite, say: &Reporter) {
    say.line("suite", counted(suite.motions().count(), "motion"));
    warn_of_doubts(suite);
    if let Some((first, why)) = suite.left_out().next() {
        words::warn(format!(
            "the suite has {} without a motion, left out, of which the first is {}: {why}; --strict refuses such suites, and topple suite \
             tells of each",
            counted(suite.left_out().count(), "line"),
            first.id
        ));
    }
}

/// Says what is in a suite.
fn tell(suite: &Suite, say: &Reporter) {
    let motions: Vec<_> = suite.motions().collect();
    let (_, recordings) = suite.recordings();
    let of = counted(recordings, "recording");
    say.line("suite", format!("{} of {of}", counted(motions.len(), "motion")));
    let noted = suite.motions().filter(|(entry, _)| !entry.notes.is_empty()).count();
    if noted > 0 {
        say.line("", format!("the column notes of the table says more about {noted} of them"));
    }
    let left_out: Vec<_> = suite.left_out().collect();
    if !left_out.is_empty() {
        say.line("left out", counted(left_out.len(), "line"));
    }
    for (entry, why) in left_out.iter().take(SHOWN) {
        say.line("", format!("{}: {why}", entry.id));
    }
    if left_out.len() > SHOWN {
        say.line("", format!("and {} more, in the table", left_out.len() - SHOWN));
    }
    if !suite.unused.is_empty() {
        say.line("unused", counted(suite.unused.len(), "file"));
    }
    for unused in suite.unused.iter().take(SHOWN) {
        say.line("", format!("{}: {}", shown::shown(&unused.file), unused.why));
    }
    if suite.unused.len() > SHOWN {
        say.line("", format!("and {} more, in run.json", suite.unused.len() - SHOWN));
    }
}

/// A suite's error in terms of the command line: all of it is what was given.
pub fn input_error(error: SuiteError) -> InputError {
    InputError(with_columns(&error.to_string()))
}
