//! Flags that studies of a suite have: the motions, limits, intervals, columns of a map, and the hazard of the site; and what run.json says of
//! them.

use std::path::{Path, PathBuf};

use topple::backend::report::threads;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::shard::Shard;
use topple::results::store_error::StoreError;
use topple::scene::Values;
use topple::scene::builder::SceneBuilder;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::path_text::PathText;
use topple::scene::record::{Baseline, Units};
use topple::sweep::error::SweepError;
use topple::sweep::settings::Method;
use topple_manifest::{Drawn, Site, Source, Study, Unknown};
use topple_studies::Bootstrap;
use topple_studies::fragility::{HazardText, hazard, hazard_text};
use topple_studies::suites::columns::asked;
use topple_studies::suites::envelope::Limits;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::read::Reading;
use topple_studies::suites::swept::SuiteSweep;
use topple_studies::suites::{Groups, Resample, Suite, SuiteRequest, saved};
use topple_studies::uncertain::Varied;

use super::call::Call;
use super::errors::sweep_error;
use super::inputs::{self, InputReader, Inputs, Repeats};
use super::numbers::{number, seed};
use super::options::{CommonFlags, RunOptions, Verify, flag_error};
use super::written::one_of;
use super::{InputError, interrupt, suite, words};

/// The motions, and how they are run. What is refused under a suite is not in the help: a friction, and a scene's file.
#[derive(clap::Args)]
#[command(mut_args(|flag| without(flag, &["friction", "save_scene"])))]
pub struct SuiteFlags {
    /// Folder, zip or list of records, as for topple suite
    #[arg(long, value_name = "PATH", help_heading = "Suite")]
    pub suite: PathBuf,
    /// Refuse a suite in which a file is missing, ambiguous or unused
    #[arg(long, help_heading = "Suite")]
    pub strict: bool,
    /// What to subtract from the velocities of all components whose list says nothing of it, as for topple seismic [default: none]
    #[arg(long, value_name = "none|line", value_parser = one_of::<Baseline>(), help_heading = "Suite")]
    pub baseline: Option<Baseline>,
    /// Take each motion twice, its horizontal component in both directions
    #[arg(long, help_heading = "Suite")]
    pub both_directions: bool,
    /// Number of cells, of all motions together, that the reference computes again, or none [default: 128, or as many as 30 s allow]
    #[arg(long, value_name = "N|none", help_heading = "Computing", allow_negative_numbers = true)]
    verify: Option<Verify>,
    /// Continue an interrupted run in the same directory, or join the shards that --tile wrote there
    #[arg(long, help_heading = "Computing")]
    pub resume: bool,
    /// Run only the k-th of n shards of the motions and keep it in the directory for --resume
    #[arg(long, value_name = "K/N", help_heading = "Computing")]
    pub tile: Option<Shard>,
    /// Run only a sample, and print the expected time
    #[arg(long, help_heading = "Computing")]
    pub dry_run: bool,
    /// The run that this one repeats.
    #[arg(skip)]
    pub repeats: Option<Repeats>,
}

/// A flag, which the help leaves out if it is one of those that are refused.
pub fn without(flag: clap::Arg, refused: &[&str]) -> clap::Arg {
    let is_refused = refused.contains(&flag.get_id().as_str());
    if is_refused { flag.hide(true) } else { flag }
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

    /// Reads the suite; from here on Ctrl-C is heard.
    pub fn read(&self) -> Result<Suite, InputError> {
        interrupt::listen();
        let reading = Reading { strict: self.strict, baseline: self.baseline };
        let suite = Suite::read_as(&self.suite, reading).map_err(suite::input_error)?;
        if let Some(Repeats { records, .. }) = &self.repeats {
            inputs::unchanged(&suite, records).map_err(|problem| {
                InputError(format!("--suite: {}: {problem}", self.suite.display()))
            })?;
        }
        Ok(suite)
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

/// The limits that a base must keep.
#[derive(clap::Args)]
pub struct LimitFlags {
    /// Share of the motions under which the block must stand
    #[arg(long, value_name = "SHARE", default_value = "1", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    standing: f64,
    /// Limit of max |u|, m: the available room [default: none]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_u: Option<f64>,
    /// Limit of the stroke of v, m: the available room [default: none]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_v: Option<f64>,
}

impl LimitFlags {
    /// As they are requested, and as run.json has them.
    pub fn limits(&self) -> Limits {
        Limits { standing: self.standing, u: self.limit_u, v: self.limit_v }
    }
}

/// The flags of the intervals.
#[derive(clap::Args)]
pub struct IntervalFlags {
    /// What is resampled for the intervals: event, recording (both components of a station, both directions) or motion
    /// [default: event if the event of each motion is known and there are at least 10, else recording]
    #[arg(long, value_name = "WHAT", help_heading = "Suite", value_parser = one_of::<Resample>())]
    pub resample: Option<Resample>,
    /// Seed of the resampling, at most 4294967295
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, help_heading = "Suite")]
    pub seed: u32,
}

impl IntervalFlags {
    /// What run.json says of what was drawn.
    pub fn record(&self, drawn: Option<(&Groups, &Bootstrap)>) -> Drawn {
        Drawn {
            resample: drawn.map(|(groups, _)| groups.by),
            groups: drawn.map(|(groups, _)| groups.count),
            replicates: drawn.map(|(_, bootstrap)| bootstrap.replicates),
            seed: self.seed,
        }
    }
}

/// What run.json says of numbers that are not known.
pub fn unknown(vary: &[Varied], samples: u32) -> Unknown {
    Unknown { vary: vary.to_vec(), samples: (!vary.is_empty()).then_some(samples) }
}

/// Which columns.
#[derive(clap::Args)]
pub struct FurtherFlags {
    /// Columns of a map whose 50, 84 and 100 % are told, too, by their names in map.csv
    #[arg(long, value_name = "NAME,...", help_heading = "Suite")]
    columns: Option<ColumnSet>,
}

impl FurtherFlags {
    /// Those that are asked for, none without the flag.
    pub fn columns(&self) -> Vec<Column> {
        self.columns.map(asked).unwrap_or_default()
    }
}

/// Their names.
pub fn names(columns: &[Column]) -> Vec<String> {
    columns.iter().map(|column| column.entry().name.into()).collect()
}

/// The flags of the hazard curve.
#[derive(clap::Args)]
pub struct HazardFlags {
    /// Hazard curve: a CSV of levels and annual rates of exceedance, or a site's curve as OpenQuake exports it
    #[arg(long, value_name = "FILE", help_heading = "Fragility")]
    hazard: Option<PathBuf>,
    /// Units of the hazard curve's levels, where they are accelerations [default: those of its header, else m/s2]
    #[arg(long, value_name = "UNITS", help_heading = "Fragility", requires = "hazard", value_parser = one_of::<Units>())]
    hazard_units: Option<Units>,
}

impl HazardFlags {
    /// Where it lies; none where no rates are requested.
    pub fn path(&self) -> Option<&Path> {
        self.hazard.as_deref()
    }

    /// The same with its flag, to be changed by a repetition.
    pub fn file(&mut self) -> Option<(&'static str, &mut PathBuf)> {
        Some((inputs::HAZARD, self.hazard.as_mut()?))
    }

    /// Reads it, over a measure.
    pub fn read(
        &self,
        im: Intensity,
        inputs: &mut InputReader,
    ) -> Result<Option<HazardText>, InputError> {
        let Some(path) = self.path() else { return Ok(None) };
        let named =
            |problem: String| InputError(format!("--hazard: {}: {problem}", path.display()));
        let most = (hazard::LARGEST, "give a file that can be read");
        let bytes = inputs.read(inputs::HAZARD, path, most)?;
        let read = hazard_text::of_bytes(&bytes, im, self.hazard_units);
        let read = read.map_err(|error| named(error.to_string()))?;
        for doubt in read.doubts(im, "--hazard-units") {
            words::warn(format!("--hazard: {}: {doubt}", path.display()));
        }
        Ok(Some(read))
    }
}

/// What run.json says of a hazard curve, and of the files that were read.
pub fn site(path: Option<&Path>, hazard: Option<HazardText>, inputs: Inputs) -> Site {
    Site {
        hazard: path.map(|path| PathText(path.into())),
        hazard_units: hazard.as_ref().map(|hazard| hazard.unit.into()),
        hazard_curve: hazard.as_ref().map(|hazard| hazard.curve.points()),
        hazard_source: hazard.map(|hazard| hazard.source),
        inputs,
    }
}

/// What annual rates are told over.
pub struct RateFlags<'a> {
    /// The hazard curve, where rates are requested.
    pub hazard: &'a HazardFlags,
    /// Its measure.
    pub im: Intensity,
    /// Levels of it to which each motion is scaled.
    pub levels: Option<&'a Values>,
}
