//! Options that every run has.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use topple::backend::backend_error::BackendError;
use topple::backend::ready::Backend;
use topple::backend::request::{BackendRequest, OpenBackends};
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::refine::run as refine;
use topple::results::column_set::ColumnSet;
use topple::results::earlier::Kind;
use topple::results::shard::Shard;
use topple::scene::builder::SceneBuilder;
use topple::scene::parameters::PARAMETERS;
use topple::scene::{Directions, Grid, Overturn, Parameter, Pressure, Scene, SceneError, Values};
use topple::sweep::settings::{Method, RunSettings, Saving, VerifySettings};
use topple::work::threads::too_many;
use topple_manifest::{Manifest, Run};
use topple_pictures::map::spectrum;

use super::errors::sweep_error;
use super::map_file::{MapFile, SPECTRUM};
use super::numbers::{BaseNumbers, BlockNumbers, RunNumbers, in_order, number};
use super::picture_flags::PictureFlags;
use super::uncertain::UncertainFlags;
use super::words::with_flags;
use super::written::one_of;
use super::{InputError, memory, words};

/// Where results go, and what computes them.
#[derive(Debug, Clone, clap::Args)]
pub struct RunOptions {
    /// Directory for the results; created if it does not exist
    #[arg(short, long, value_name = "DIR", default_value = "topple-out")]
    pub out: PathBuf,
    /// What computes; auto takes a real GPU if there is one, else the CPU [default: auto]
    #[arg(long, value_parser = one_of::<BackendRequest>())]
    pub backend: Option<BackendRequest>,
    /// GPUs to use, by their numbers in topple adapters [default: all that are of the same kind as the best one]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub adapter: Vec<usize>,
    /// Number type of the sweep [default: f32]
    #[arg(long, value_parser = one_of::<Precision>())]
    pub precision: Option<Precision>,
    /// Largest step, s [default: 0.0078125, 1/128]
    #[arg(long, value_name = "S", value_parser = number, allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// Run each cell again in f64 with half the step, and mark cells whose outcome changes as unresolved
    #[arg(long)]
    pub resolve: bool,
    /// Turn off the shortcuts that cannot change the result
    #[arg(long)]
    pub full_model: bool,
    /// Accept implausible numbers
    #[arg(long)]
    pub force: bool,
    /// Threads of the CPU [default: one per core]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZeroUsize>,
    /// Print only warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
    #[command(flatten)]
    pub pictures: PictureFlags,
}

/// What a map prints.
#[derive(Debug, Clone, Copy, clap::Args)]
pub struct Talk {
    /// Also print the time of each phase
    #[arg(short, long, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Print run.json instead of text
    #[arg(long, conflicts_with_all = ["quiet", "verbose"])]
    pub json: bool,
}

/// What a map may have beside its outcomes, whether it is run or joined of shards.
#[derive(Debug, Clone, clap::Args)]
pub struct MapParts {
    /// Refine the cells beside boundaries in K levels, each of half the cell size; writes pictures of the finest grid and the tables
    /// leaves.csv, leaves.npz or leaves.zarr
    #[arg(long, value_name = "K")]
    pub refine: Option<u32>,
    /// With --refine: also split boxes in which ζ, min_contact or a stroke differs from the interpolation between their corners by more
    /// than this share of its range
    #[arg(long, value_name = "SHARE", requires = "refine", value_parser = share, allow_negative_numbers = true)]
    pub smooth: Option<f64>,
    /// Measure how sharp the boundaries between outcomes are: basin entropy, uncertainty exponent, dimension
    #[arg(long)]
    pub sharpness: bool,
    /// Draw the spectra of a map of two axes, too: the least values of the second at which the block lifts and overturns, and the
    /// rocking index at some of them, over the first (spectrum.csv, .png, .svg)
    #[arg(long)]
    pub spectrum: bool,
}

impl MapParts {
    /// Refuses what the map of a scene cannot have.
    ///
    /// # Errors
    /// The flag, and what to do.
    pub fn check(&self, scene: &Scene) -> Result<(), InputError> {
        if self.spectrum && !spectrum::has(&Grid::of(scene)) {
            let problem = "--spectrum: spectra are of a map of two axes, the second of them how strong the shaking is (--a-h, --scale), above 0; give these, or leave it out";
            return Err(InputError(problem.into()));
        }
        let refined = self.refine.map_or(Ok(()), |levels| refine::check(scene, levels));
        refined.map_err(|error| flag_error(&error))
    }
}

/// The flags that cannot stand beside some parts of a map.
fn apart(flag: clap::Arg) -> clap::Arg {
    match flag.get_id().as_str() {
        "refine" => flag.conflicts_with_all(["repair", "tile", "dry_run"]),
        "sharpness" | "spectrum" => flag.conflicts_with_all(["tile", "dry_run"]),
        _ => flag,
    }
}

/// Further parts of a map.
#[derive(Debug, Clone, clap::Args)]
#[command(mut_args(apart))]
pub struct MapOptions {
    #[command(flatten)]
    pub run: RunOptions,
    /// Continue an interrupted run in the same directory
    #[arg(long)]
    pub resume: bool,
    /// Shortest time between two savings of finished cells for --resume, s: for tests of runs that are killed, and for measurements
    #[arg(long, hide = true, value_name = "S", default_value = "2", value_parser = seconds, allow_negative_numbers = true)]
    pub keep_every: Duration,
    /// Run only the k-th of n shards and keep it in the directory for topple merge
    #[arg(long, value_name = "K/N", conflicts_with_all = ["verify", "files"])]
    pub tile: Option<Shard>,
    /// Files of the map [default: csv,npz; zarr alone above 16.7 million cells]
    #[arg(long, value_name = "FILE,...", value_delimiter = ',')]
    pub files: Vec<MapFile>,
    /// Columns of the map, by their names in map.csv, or all but for those that are only on request; a cell ends when these columns are final [default: all]
    #[arg(long, value_name = "NAME,...")]
    pub columns: Option<ColumnSet>,
    /// Number of cells that the reference computes again, or none [default: 128, or as many as 30 s allow]
    #[arg(long, value_name = "N|none", allow_negative_numbers = true)]
    pub verify: Option<Verify>,
    /// Run the cells beside a boundary between outcomes again in f64 with half the step, and replace those that change
    #[arg(long, conflicts_with_all = ["resolve", "dry_run"])]
    pub repair: bool,
    #[command(flatten)]
    pub parts: MapParts,
    /// Run only a sample, and print the expected time, memory and room on the disk
    #[arg(long)]
    pub dry_run: bool,
    #[command(flatten)]
    pub talk: Talk,
    #[command(flatten)]
    pub uncertain: UncertainFlags,
}

/// What the reference is to run again.
#[derive(Debug, Clone, Copy)]
pub struct Verify(VerifySettings);

impl Verify {
    /// As settings; those of a run that asks for none in particular by default.
    pub fn settings(asked: Option<Verify>) -> VerifySettings {
        asked.map_or_else(VerifySettings::default, |Verify(settings)| settings)
    }
}

impl FromStr for Verify {
    type Err = String;

    fn from_str(text: &str) -> Result<Verify, String> {
        match (text, text.parse::<usize>()) {
            ("none", _) => Ok(Verify(VerifySettings::cells(0))),
            (_, Ok(cells)) => Ok(Verify(VerifySettings::cells(cells))),
            _ => Err("must be a number of cells or none".into()),
        }
    }
}

impl RunOptions {
    /// Refuses a step that is not plausible.
    ///
    /// # Errors
    /// The key `step`.
    pub fn check_step(&self) -> Result<(), SceneError> {
        self.method().check_step(self.force)
    }

    /// Sets the number of threads that work on the CPU. Call it before any does.
    pub fn set_threads(&self) -> Result<(), InputError> {
        set_threads(self.threads)
    }

    /// The plan of a scene.
    pub fn plan(&self, scene: &Scene) -> Result<Plan, SceneError> {
        self.check_step()?;
        self.method().plan(scene)
    }

    /// How cells are computed.
    pub fn method(&self) -> Method {
        let usual = Method::default();
        Method {
            precision: self.precision.unwrap_or(usual.precision),
            largest_step: self.step.unwrap_or(usual.largest_step),
            resolve: self.resolve,
            full_model: self.full_model,
            ..usual
        }
    }

    /// Number type of the sweep.
    pub fn precision(&self) -> Precision {
        self.method().precision
    }

    /// What to compute on.
    pub fn backend(&self) -> BackendRequest {
        self.backend.unwrap_or(BackendRequest::Auto)
    }

    /// Takes over how an earlier run computed its cells, and on what, where no flag says otherwise. Of a GPU it is
    /// only known that there was one.
    pub fn adopt(&mut self, backend: Option<&str>, earlier: Option<Method>) {
        self.backend = self.backend.or(match backend {
            Some("reference") => Some(BackendRequest::Reference),
            Some("cpu") => Some(BackendRequest::Cpu),
            _ => None,
        });
        let Some(earlier) = earlier else { return };
        self.precision.get_or_insert(earlier.precision);
        // A step that was accepted once is.
        if self.step.is_none() {
            self.step = Some(earlier.largest_step);
            self.force = true;
        }
        self.resolve |= earlier.resolve;
        self.full_model |= earlier.full_model;
    }

    /// Opens what to compute on: one backend, or as many as there are GPUs; all alike.
    pub fn open_backends(&self) -> anyhow::Result<Vec<Backend>> {
        let opened = self.backend().open(self.precision(), &self.adapter);
        let OpenBackends { backends, passed_over } = opened.map_err(|e| sweep_error(e.into()))?;
        self.warn_of(&passed_over, &backends[0]);
        Ok(backends)
    }

    /// Warns of GPUs that were passed over.
    pub fn warn_of(&self, passed_over: &[BackendError], taken: &Backend) {
        let on = if taken.adapter().is_some() { "another GPU" } else { "the CPU" };
        for error in passed_over {
            words::warn(format!("{}; computing on {on}", with_flags(&error.to_string())));
        }
    }
}

/// Sets the number of threads, where one was given.
pub fn set_threads(threads: Option<NonZeroUsize>) -> Result<(), InputError> {
    let Some(count) = threads else { return Ok(()) };
    if let Some(problem) = too_many(count) {
        return Err(InputError(format!("--threads: {problem}")));
    }
    let built = rayon::ThreadPoolBuilder::new().num_threads(count.get()).build_global();
    built.map_err(|error| InputError(format!("--threads: {error}; give fewer")))
}

impl MapOptions {
    /// Takes over how an earlier run computed its cells, on what, and what its map had besides, where no flag says
    /// otherwise. What is returned are the flags of that run which cannot stand beside those that are given.
    pub fn adopt(&mut self, Manifest { run, files, .. }: &Manifest) -> Vec<&'static str> {
        let of = run.of_scene();
        let earlier = of.and_then(|of| of.method);
        let map = match run {
            Run::Map(map) => Some(map),
            _ => None,
        };
        let refinement = map.and_then(|map| map.refined.as_ref());
        let mut left_out = Vec::new();
        let mut takes = |flag, wanted: bool, excluded: bool| {
            left_out.extend((wanted && excluded).then_some(flag));
            wanted && !excluded
        };
        // See what the flags themselves exclude, in [`MapOptions`].
        let (shard, sample) = (self.tile.is_some(), self.dry_run);
        let (repairs, refines) = (self.repair, self.parts.refine.is_some());
        let unknown = self.uncertain.asked();
        let resolved = earlier.is_some_and(|earlier| earlier.resolve) && !self.run.resolve;
        let resolve = takes("--resolve", resolved, repairs);
        let repaired = earlier.is_some_and(|earlier| earlier.repair) && !repairs;
        let not_repaired = self.run.resolve || sample || refines || unknown;
        self.repair |= takes("--repair", repaired, not_repaired);
        let refined = refinement.is_some() && !refines;
        if takes("--refine", refined, repairs || shard || sample || unknown) {
            self.parts.refine = refinement.map(|of| of.levels.len() as u32);
        }
        if self.parts.refine.is_some() && self.parts.smooth.is_none() {
            self.parts.smooth = refinement.and_then(|of| of.smooth);
        }
        let sharp = map.is_some_and(|map| map.sharpness.is_some()) && !self.parts.sharpness;
        self.parts.sharpness |= takes("--sharpness", sharp, shard || sample || unknown);
        let spectrum = files.iter().any(|file| file == SPECTRUM) && !self.parts.spectrum;
        self.parts.spectrum |= takes("--spectrum", spectrum, shard || sample || unknown);
        if self.columns.is_none() && !unknown {
            self.columns =
                earlier.map(|earlier| earlier.columns).filter(|columns| !columns.is_all());
        }
        // A shard has no pictures.
        if !shard {
            self.run.pictures.adopt(run.pictures().clone());
        }
        // A shard, a sample and probabilities have no files of a map.
        if self.files.is_empty() && !shard && !unknown {
            self.files = MapFile::among(files);
        }
        let resolve = resolve || self.run.resolve;
        let backend = of.and_then(|of| of.backend.as_deref());
        self.run.adopt(backend, earlier.map(|earlier| Method { resolve, ..earlier }));
        left_out
    }

    /// What the files are of.
    pub fn kind(&self) -> Kind {
        if self.uncertain.asked() { Kind::Probability } else { Kind::Map }
    }

    /// Refuses what is wrong with a scene before anything is made.
    pub fn check(&self, scene: &Scene) -> Result<(), InputError> {
        self.run.pictures.print().map_err(InputError)?;
        if self.tile.is_some() && !self.run.pictures.record().is_plain() {
            let problem =
                format!("a shard has no pictures; give {} to topple merge", PictureFlags::NAMES);
            return Err(InputError(format!("--tile: {problem}")));
        }
        self.run.plan(scene).map_err(|error| flag_error(&error))?;
        self.method().check_columns(scene).map_err(|error| flag_error(&error))?;
        let verify = Verify::settings(self.verify);
        verify.check(Grid::of(scene).len()).map_err(|error| flag_error(&error))?;
        self.parts.check(scene)?;
        self.uncertain.check(scene, self.run.force).map_err(|error| flag_error(&error))
    }

    /// How the cells of its map are computed.
    pub fn method(&self) -> Method {
        let columns = self.columns.unwrap_or_default();
        Method { repair: self.repair, columns, ..self.run.method() }
    }

    /// The settings of a scene's run.
    pub fn settings(&self, scene: &Scene) -> RunSettings {
        let mut settings = RunSettings::default();
        settings.backend = self.run.backend();
        settings.adapters.clone_from(&self.run.adapter);
        settings.method = self.method();
        settings.saving = Some(Saving {
            resume: self.resume,
            every: self.keep_every,
            memory: memory::for_columns(scene, self.run.precision()),
            shard: self.tile,
            ..Saving::to(&self.run.out)
        });
        settings
    }

    /// The files that a map is written to.
    pub fn files(&self, grid: &Grid) -> Vec<MapFile> {
        if self.files.is_empty() { MapFile::of(grid.len()) } else { self.files.clone() }
    }
}

/// The flags that every scene has. Every number takes a value, start:stop:count, start:stop:count:log, or
/// a,b,c.
#[derive(clap::Args)]
pub struct CommonFlags {
    /// A block of the paper's Table 1 with its plates: 1 caryatid, 2 server cabinet, 3 hospital
    /// cabinet
    #[arg(long, value_name = "1|2|3", help_heading = "Block")]
    object: Option<u32>,
    #[command(flatten)]
    block: BlockNumbers,
    /// Directions in which the base is isolated; a locked direction needs no period [default: dual]
    #[arg(long, value_name = "DIRECTIONS", help_heading = "Base", value_parser = one_of::<Directions>())]
    isolation: Option<Directions>,
    /// Vertical force on a friction pendulum: follows the motion, or is constant [default: follows]
    #[arg(long, value_name = "FORCE", help_heading = "Base", value_parser = one_of::<Pressure>())]
    pressure: Option<Pressure>,
    #[command(flatten)]
    base: BaseNumbers,
    #[command(flatten)]
    run: RunNumbers,
    /// When a block counts as overturned [default: critical-angle]
    #[arg(long, value_name = "WHEN", help_heading = "Run", value_parser = one_of::<Overturn>())]
    overturn: Option<Overturn>,
    /// Write the scene of these flags (not how it is computed) to a new file, or to stdout with -, and run nothing
    #[arg(long, value_name = "FILE", help_heading = "Run")]
    pub save_scene: Option<PathBuf>,
    /// Number on the picture's horizontal axis
    #[arg(long, value_name = "KEY", help_heading = "Run", value_parser = parameter)]
    x: Option<Parameter>,
    /// Number on the picture's vertical axis
    #[arg(long, value_name = "KEY", help_heading = "Run", value_parser = parameter)]
    y: Option<Parameter>,
}

impl CommonFlags {
    /// The scene so far, with other numbers than those that every scene has, and without its excitation.
    pub fn text(
        &self,
        title: Option<&str>,
        more: impl Iterator<Item = (usize, Parameter, Values)>,
    ) -> SceneBuilder {
        let own = self.block.placed().chain(self.base.placed()).chain(self.run.placed());
        SceneBuilder {
            title: title.map(String::from),
            object: self.object,
            isolation: self.isolation,
            pressure: self.pressure,
            overturn: self.overturn,
            shape: None,
            record: None,
            numbers: in_order(own.chain(more)),
            force: false,
            x: self.x,
            y: self.y,
        }
    }
}

/// A number by its key, written as a flag or as in a file.
fn parameter(text: &str) -> Result<Parameter, String> {
    let key = text.trim_start_matches('-').replace('-', "_");
    Parameter::of_key(&key).ok_or_else(|| {
        let known: Vec<&str> = PARAMETERS.iter().map(|entry| entry.key).collect();
        format!("no number has this key; there are {}", known.join(", "))
    })
}

/// A number of threads.
fn threads(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "must be a number of threads, 1 or more".into())
}

/// A share of a range.
pub fn share(text: &str) -> Result<f64, String> {
    let parsed = text.parse::<f64>().ok().filter(|share| *share > 0.0 && *share < 1.0);
    parsed.ok_or_else(|| "must be a number above 0 and below 1".into())
}

/// A time in seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let parsed = text.parse::<f64>().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    parsed.ok_or_else(|| "must be a number of seconds, 0 or more".into())
}

/// A scene's error in terms of flags.
pub fn flag_error(error: &SceneError) -> InputError {
    InputError(format!("{}: {}", error.flag(), with_flags(&error.problem)))
}
