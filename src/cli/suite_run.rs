//! What commands have that sweep a scene under a suite: their flags, and the way from them to the sweep.

use std::path::PathBuf;

use topple::results::part::Part;
use topple::results::store_error::StoreError;
use topple::scene::builder::SceneBuilder;
use topple::scene::{Directions, Parameter};
use topple::suites::swept::{SuiteJob, SuiteSettings, SuiteSweep};
use topple::suites::verified::Verified;
use topple::suites::wanted::WantedMotion;
use topple::suites::{Suite, saved};
use topple::sweep::error::SweepError;
use topple::sweep::settings::RunSettings;

use super::errors::sweep_error;
use super::estimate::duration;
use super::options::{CommonFlags, RunOptions, Verify, flag_error};
use super::progress::Screen;
use super::words::Say;
use super::{InputError, interrupt, output, suite};

/// Which motions, and how they are run.
#[derive(clap::Args)]
pub struct SuiteFlags {
    /// A folder, a zip or a list of records, as of topple suite
    #[arg(long, value_name = "PATH", help_heading = "Suite")]
    pub suite: PathBuf,
    /// Refuse a suite in which anything is missing or ambiguous
    #[arg(long, help_heading = "Suite")]
    strict: bool,
    /// Take each motion twice, its horizontal component in both directions
    #[arg(long, help_heading = "Suite")]
    both_directions: bool,
    /// Cells that the reference runs again, of all motions together, or none [default: 128, or as many as 30 s allow]
    #[arg(long, value_name = "N|none", allow_negative_numbers = true)]
    verify: Option<Verify>,
    /// Go on with an interrupted run in the same directory, or with parts that --tile has left there
    #[arg(long)]
    resume: bool,
    /// Run the k-th of n parts of the motions only, and leave it in the directory for --resume
    #[arg(long, value_name = "K/N")]
    tile: Option<Part>,
    /// Print the expected time, and run a sample only
    #[arg(long)]
    dry_run: bool,
}

/// The scene, its suite, and how it is to be run.
pub struct SuiteInput {
    /// The scene, without its excitation.
    pub text: SceneBuilder,
    /// The motions.
    pub suite: Suite,
    /// Sets of numbers under each motion: one, where none vary.
    pub points: usize,
}

impl SuiteFlags {
    /// Checks what can be checked before anything is read, and reads the suite.
    pub fn read(
        &self,
        common: &CommonFlags,
        options: &RunOptions,
        text: SceneBuilder,
    ) -> anyhow::Result<SuiteInput> {
        options.set_threads()?;
        options.check_step().map_err(|error| flag_error(&error))?;
        if common.save_scene.is_some() {
            let problem = "--save-scene: a scene's file has no suite; leave it out";
            return Err(InputError(problem.into()).into());
        }
        let text = SceneBuilder { force: options.force, ..text };
        check_device(&text)?;
        let suite = Suite::read(&self.suite, self.strict).map_err(suite::input_error)?;
        Ok(SuiteInput { text, suite, points: 1 })
    }

    /// The motions as they are.
    pub fn motions(&self, input: &SuiteInput) -> Vec<WantedMotion> {
        WantedMotion::of_suite(&input.suite, &input.text.numbers, self.both_directions)
    }

    /// Runs the scene under motions; none where no result is wanted: of a dry run, and of a part.
    pub fn run(
        &self,
        input: &SuiteInput,
        motions: Vec<WantedMotion>,
        options: &RunOptions,
        say: &Say,
    ) -> anyhow::Result<Option<SuiteSweep>> {
        let mut run = RunSettings::default();
        run.backend = options.backend();
        run.adapters.clone_from(&options.adapter);
        run.method = options.method();
        run.verify = Verify::settings(self.verify);
        if saved::is_begun(&options.out) && !self.resume && self.tile.is_none() && !self.dry_run {
            let error = SweepError::Folder(StoreError::Unfinished(options.out.clone()));
            return Err(sweep_error(error));
        }
        let saving = (!self.dry_run).then(|| saved::folder(&options.out));
        let settings = SuiteSettings { run, saving, part: self.tile };
        interrupt::listen();
        let screen = Screen::new(options.quiet);
        let job = SuiteJob::open(&input.text, motions, settings).map_err(sweep_error)?;
        options.warn_of(&job.backends().passed_over, &job.backends().backends[0]);
        if self.resume && job.finds_others().map_err(sweep_error)? {
            let folder = saved::folder(&options.out);
            let problem = format!(
                "--resume: {} holds motions of another run; give the flags of that run, or another directory",
                folder.display()
            );
            return Err(InputError(problem).into());
        }
        let (cells, each, count) = (job.cells(), job.grid.len(), job.motions().len());
        let levels = cells / (each * count).max(1);
        let size = size(&job, input.points, levels);
        if self.dry_run {
            let seconds = job.estimate(&screen).map_err(sweep_error)?;
            screen.clear();
            // What is asked for is told, however quiet.
            let say = Say::unless(false);
            say.line("cells", format!("{size}, {cells} together"));
            say.line("time", format!("about {} of sweep", duration(seconds)));
            return Ok(None);
        }
        output::open(&options.out)?;
        let swept = job.run(&screen).map_err(sweep_error)?;
        screen.clear();
        if self.resume {
            say.line("resumed", format!("{} of {count} motions were done", swept.resumed));
        }
        let ran = cells - swept.resumed * each * levels;
        if ran > 0 {
            let speed = ran as f64 / swept.seconds.max(1.0e-9);
            let text =
                format!("{size}, {:.2} s, {speed:.0} records x cells a second", swept.seconds);
            say.line("sweep", text);
        }
        if let Some(part) = self.tile {
            tell_verified(&swept, say);
            let folder = saved::folder(&options.out);
            let joins = "the same command without --tile and with --resume joins the parts";
            say.line("motions", format!("part {part} in {}; {joins}", folder.display()));
            return Ok(None);
        }
        Ok(Some(swept))
    }

    /// Takes away what was saved while it ran, when the results are written.
    pub fn finish(&self, options: &RunOptions) -> anyhow::Result<()> {
        Ok(saved::discard(&options.out)?)
    }
}

/// Refuses a base that is another device under each motion.
fn check_device(text: &SceneBuilder) -> Result<(), InputError> {
    let moves = text.isolation.unwrap_or(Directions::Dual).moves_h();
    let fixed = [Parameter::UY, Parameter::YieldForce].iter().any(|own| text.numbers.has(*own));
    if moves && !fixed && !text.force {
        let problem = "--u-y: missing; --alpha-y makes another device of the base under each motion: give --u-y or \
                       --yield-force (--force takes alpha_y all the same)";
        return Err(InputError(problem.into()));
    }
    Ok(())
}

/// Refuses limits of a stroke that the base does not have.
pub fn check_limits(text: &SceneBuilder, limits: [bool; 2]) -> Result<(), InputError> {
    let moves = text.isolation.unwrap_or(Directions::Dual);
    for (flag, limited, there) in
        [("--limit-u", limits[0], moves.moves_h()), ("--limit-v", limits[1], moves.moves_v())]
    {
        if limited && !there {
            let problem = format!("{flag}: the base does not move in this direction; leave it out");
            return Err(InputError(problem));
        }
    }
    Ok(())
}

/// How much is swept, in words: cells, motions, levels.
fn size(job: &SuiteJob, points: usize, levels: usize) -> String {
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
    let motions = job.motions().len() / points;
    let mut text = format!("{cells} under {}", suite::counted(motions, "motion"));
    if points > 1 {
        text += &format!(" with {points} sets of numbers");
    }
    if levels > 1 {
        text += &format!(" at {levels} levels");
    }
    text
}

/// Says what the reference says.
pub fn tell_verified(swept: &SuiteSweep, say: &Say) {
    let Verified { sampled, differ, inside, wrong } = &swept.verified;
    if *sampled == 0 {
        return;
    }
    let verdict = match inside {
        0 => "none of them amid one outcome".to_string(),
        some => format!("{some} of them amid one outcome: the sweep is not right there"),
    };
    say.line("reference", format!("{sampled} cells again, {differ} differ in outcome, {verdict}"));
    for place in wrong.iter().take(SHOWN) {
        say.line("", place);
    }
}

/// Wrong cells that are printed.
const SHOWN: usize = 3;
