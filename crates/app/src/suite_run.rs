//! What commands have that sweep a scene under a suite: their flags, and the way from them to the sweep.

use std::path::{Path, PathBuf};

use topple::backend::report::threads;
use topple::results::shard::Shard;
use topple::results::store_error::StoreError;
use topple::scene::builder::SceneBuilder;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::path_text::PathText;
use topple::scene::record::Baseline;
use topple::scene::{Grid, Parameter, Scene, Values};
use topple::sweep::error::SweepError;
use topple::sweep::settings::Method;
use topple_manifest::{CommandLine, Source, Sources, Study};
use topple_studies::suites::read::Reading;
use topple_studies::suites::swept::{SuiteJob, SuiteSweep};
use topple_studies::suites::verified::Verified;
use topple_studies::suites::{Suite, SuiteRequest, saved};

use super::call::Call;
use super::errors::sweep_error;
use super::estimate::duration;
use super::inputs::{InputReader, Inputs};
use super::options::{CommonFlags, RunOptions, Verify, flag_error};
use super::progress::Screen;
use super::results_directory::{self, Place};
use super::words::{Reporter, counted};
use super::written::one_of;
use super::{InputError, device_remarks, interrupt, suite, words};

/// The motions, and how they are run. What is refused under a suite is not in the help: a friction, and a scene's file.
#[derive(clap::Args)]
#[command(mut_args(|flag| without(flag, &["friction", "save_scene"])))]
pub struct SuiteFlags {
    /// Folder, zip or list of records, as for topple suite
    #[arg(long, value_name = "PATH", help_heading = "Suite")]
    suite: PathBuf,
    /// Refuse a suite in which a file is missing, ambiguous or unused
    #[arg(long, help_heading = "Suite")]
    strict: bool,
    /// What to subtract from the velocities of all components whose list says nothing of it, as for topple seismic [default: none]
    #[arg(long, value_name = "none|line", value_parser = one_of::<Baseline>(), help_heading = "Suite")]
    baseline: Option<Baseline>,
    /// Take each motion twice, its horizontal component in both directions
    #[arg(long, help_heading = "Suite")]
    both_directions: bool,
    /// Number of cells, of all motions together, that the reference computes again, or none [default: 128, or as many as 30 s allow]
    #[arg(long, value_name = "N|none", help_heading = "Computing", allow_negative_numbers = true)]
    verify: Option<Verify>,
    /// Continue an interrupted run in the same directory, or join the shards that --tile wrote there
    #[arg(long, help_heading = "Computing")]
    resume: bool,
    /// Run only the k-th of n shards of the motions and keep it in the directory for --resume
    #[arg(long, value_name = "K/N", help_heading = "Computing")]
    tile: Option<Shard>,
    /// Run only a sample, and print the expected time
    #[arg(long, help_heading = "Computing")]
    dry_run: bool,
    /// The run that this one repeats.
    #[arg(skip)]
    repeats: Option<Repeats>,
}

/// A flag, which the help leaves out if it is one of those that are refused.
pub fn without(flag: clap::Arg, refused: &[&str]) -> clap::Arg {
    let is_refused = refused.contains(&flag.get_id().as_str());
    if is_refused { flag.hide(true) } else { flag }
}

/// A run that is repeated.
#[derive(Debug, Clone)]
pub struct Repeats {
    /// The words that say so.
    pub line: CommandLine,
    /// What its motions were read from.
    pub records: Sources,
    /// Checksums of the other files that it read.
    pub inputs: Inputs,
}

impl SuiteFlags {
    /// Checks what is said of the run, and makes a request of a scene.
    pub fn request(
        &self,
        common: &CommonFlags,
        options: &RunOptions,
        text: SceneBuilder,
    ) -> anyhow::Result<SuiteRequest> {
        options.set_threads()?;
        options.check_step().map_err(|error| flag_error(&error))?;
        if common.save_scene.is_some() {
            let problem = "--save-scene: a scene's file has no suite; leave it out";
            return Err(InputError(problem.into()).into());
        }
        if saved::is_begun(&options.out) && !self.resume && self.tile.is_none() && !self.dry_run {
            let error = SweepError::Folder(StoreError::Unfinished(options.out.clone()));
            return Err(sweep_error(error));
        }
        let mut request = SuiteRequest::new(SceneBuilder { force: options.force, ..text });
        request.both_directions = self.both_directions;
        request.settings.saving = (!self.dry_run).then(|| saved::folder(&options.out));
        request.settings.shard = self.tile;
        let run = &mut request.settings.run;
        run.backend = options.backend();
        run.adapters.clone_from(&options.adapter);
        run.method = options.method();
        run.verify = Verify::settings(self.verify);
        Ok(request)
    }

    /// What reads the files beside the motions.
    pub fn inputs(&self) -> InputReader<'_> {
        InputReader::new(self.repeats.as_ref().map(|earlier| &earlier.inputs))
    }

    /// The suite's path.
    pub fn suite(&self) -> &Path {
        &self.suite
    }

    /// Makes them those of a repetition, as a whole and from the start.
    pub fn repeat(&mut self, suite: PathBuf, repeats: Repeats) {
        self.suite = suite;
        self.repeats = Some(repeats);
        (self.resume, self.tile, self.dry_run) = (false, None, false);
    }

    /// Refuses a directory in which something that no run wrote has the place of one of these files, where they are to be
    /// written: not by a dry run, nor by a shard.
    pub fn refuse_foreign(&self, place: &Place, names: &[String]) -> Result<(), InputError> {
        if self.dry_run || self.tile.is_some() {
            return Ok(());
        }
        place.refuse_foreign(names)
    }

    /// Refuses a directory of somebody else, and to resume another run. It comes before anything is warned of: what is refused is one line.
    pub fn refuse_others(&self, job: &SuiteJob, options: &RunOptions) -> anyhow::Result<()> {
        if job.finds_others().map_err(sweep_error)? && self.resume {
            let folder = saved::folder(&options.out);
            let problem = format!(
                "--resume: {} holds motions of another run; give the flags of that run, or another directory",
                folder.display()
            );
            return Err(InputError(problem).into());
        }
        Ok(())
    }

    /// Says what is swept, and that both directions of a block without an eccentricity are the same.
    pub fn tell_of_scene(&self, scenes: &[Scene], say: &Reporter) {
        let parts = match scenes {
            [] => return,
            [scene] => topple::scene::words::fixed(scene),
            scenes => words::shared_block(scenes),
        };
        let suite = self.suite.display();
        say.line("scene", format!("{}, under the motions of {suite}", parts.join(", ")));
        if let [scene] = scenes {
            words::axes(say, &Grid::of(scene));
            words::block(say, scene);
        }
        let leans = |scene: &Scene| {
            let of_centre = [Parameter::Eccentricity, Parameter::Offset];
            let values = of_centre.into_iter().filter_map(|of| scene.numbers.get(of));
            values.flat_map(Values::iter).any(|value| value != 0.0)
        };
        if self.both_directions && !scenes.iter().any(leans) {
            words::warn(
                "both directions of a motion are the same for a block without an eccentricity: --both-directions doubles the time, and nothing else",
            );
        }
    }

    /// Reads the suite; from here on Ctrl-C is heard.
    pub fn read(&self) -> Result<Suite, InputError> {
        interrupt::listen();
        let reading = Reading { strict: self.strict, baseline: self.baseline };
        let suite = Suite::read_as(&self.suite, reading).map_err(suite::input_error)?;
        if let Some(Repeats { records, .. }) = &self.repeats {
            suite::unchanged(&suite, records).map_err(|problem| {
                InputError(format!("--suite: {}: {problem}", self.suite.display()))
            })?;
        }
        Ok(suite)
    }

    /// Runs a scene under motions, each so many times for something; none where no result is wanted: of a dry run,
    /// and of a shard.
    pub fn run(
        &self,
        job: SuiteJob,
        times: (usize, &str),
        options: &RunOptions,
        say: &Reporter,
    ) -> anyhow::Result<Option<SuiteSweep>> {
        let screen = Screen::new(options.quiet);
        options.warn_of(&job.backends().passed_over, &job.backends().backends[0]);
        let (cells, each, count) = (job.cells(), job.grid.len(), job.motions().len());
        let levels = cells / (each * count).max(1);
        let size = size(&job, times, levels);
        if self.dry_run {
            let seconds = job.estimate(&screen).map_err(sweep_error)?;
            screen.clear();
            // The requested answer is printed even with --quiet.
            let say = Reporter::unless(false);
            say.line("cells", format!("{size}, {cells} together"));
            say.line("time", format!("about {} of sweep", duration(seconds)));
            return Ok(None);
        }
        results_directory::open(&options.out)?;
        let swept = job.run(&screen).map_err(sweep_error)?;
        screen.clear();
        if self.resume {
            say.line("resumed", format!("{} of {count} motions were done", swept.resumed));
        }
        let ran = cells - swept.resumed * each * levels;
        if ran > 0 {
            let speed = ran as f64 / swept.seconds.max(1.0e-9);
            let text =
                format!("{size}, {:.2} s, {speed:.0} motions x cells a second", swept.seconds);
            say.line("sweep", text);
        }
        if let Some(shard) = self.tile {
            tell_verified(&swept, say);
            let folder = saved::folder(&options.out);
            let joins = "the same command without --tile and with --resume joins the shards";
            say.line("motions", format!("shard {shard} in {}; {joins}", folder.display()));
            return Ok(None);
        }
        Ok(Some(swept))
    }

    /// What run.json says of a sweep, each of its records once.
    pub fn record(&self, swept: &SuiteSweep, suite: &Suite, options: &RunOptions) -> Study {
        let runs: usize = swept.motions.iter().map(|motion| motion.outcomes.len()).sum();
        let repeats = self.repeats.as_ref().map(|of| of.line.clone());
        let Method { precision, largest_step, resolve, full_model, repair, .. } = options.method();
        Study {
            scene: Some(swept.scene.clone()),
            device: DeviceNumbers::of(&swept.scene),
            suite: Some(PathText(self.suite.clone())),
            command: Some(repeats.unwrap_or_else(|| Call::current().command_line())),
            motions: suite.motions().map(|(entry, _)| entry.id.clone()).collect(),
            both_directions: self.both_directions,
            records: Source::of(suite),
            left_out: suite::left_out(suite),
            backend: Some(swept.backend.into()),
            adapter: swept.adapter.clone(),
            threads: threads(),
            precision: Some(precision),
            largest_step,
            resolve,
            full_model,
            repair,
            cells: swept.grid.len(),
            sweep_seconds: swept.seconds,
            records_times_cells_per_second: runs as f64 / swept.seconds.max(1.0e-9),
            pictures: options.pictures.record(),
        }
    }
}

/// Says what a device's numbers make of the base, and warns of a scene whose impacts take no energy.
pub fn tell_of_base(job: &SuiteJob, options: &RunOptions) -> Result<(), InputError> {
    let plan = options.plan(&job.scene).map_err(|error| flag_error(&error))?;
    words::device(&Reporter::unless(options.quiet), None, &job.scene);
    device_remarks::warn(&job.scene);
    words::warn_of_lossless_impacts(&plan, &job.grid);
    Ok(())
}

/// Warns of runs whose stroke no friction pendulum has.
pub fn warn_of_radius(swept: &SuiteSweep) {
    let (cells, largest) = swept.beyond_radius();
    match (swept.grid.len(), cells) {
        (_, 0) => {}
        (1, _) => {
            words::warn_of_radius(None, swept.scene.numbers.get(Parameter::Radius), largest);
        }
        _ => words::warn_of_radii(cells),
    }
}

/// How much is swept, in words: cells, motions, what each is swept several times for, levels.
fn size(job: &SuiteJob, (count, what): (usize, &str), levels: usize) -> String {
    let counts: Vec<String> = job
        .grid
        .axes()
        .iter()
        .filter(|axis| axis.count() > 1)
        .map(|axis| axis.count().to_string())
        .collect();
    let cells = match counts.is_empty() {
        true => "1 cell".to_string(),
        false => format!("{} cells", counts.join(" x ")),
    };
    // A shard has a part of them.
    let motions = job.motions().len().div_ceil(count.max(1));
    let mut text = format!("{cells} under {}", counted(motions, "motion"));
    if count > 1 {
        text += &format!(" with {count} {what}");
    }
    if levels > 1 {
        text += &format!(" at {levels} levels");
    }
    text
}

/// Says what the reference says.
pub fn tell_verified(swept: &SuiteSweep, say: &Reporter) {
    let Verified { sampled, differ, inside, wrong } = &swept.verified;
    if *sampled == 0 {
        return;
    }
    say.line("reference", words::reference(*sampled as usize, *differ as usize, *inside as usize));
    for place in wrong.iter().take(SHOWN) {
        say.line("", place);
    }
}

/// Wrong cells that are printed.
const SHOWN: usize = 3;
