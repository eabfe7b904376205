//! Options that every run has.

use std::path::PathBuf;
use std::time::Duration;

use topple::model::precision::Precision;
use topple::scene::parameters::PARAMETERS;
use topple::scene::text::SceneText;
use topple::scene::{Directions, Overturn, Parameter, Scene, SceneError, Values};
use topple::store::identity::Manner;
use topple::store::part::Part;
use topple::sweep::backend::Backend;
use topple::sweep::clock::DEFAULT_STEP;
use topple::sweep::gpu::GpuError;
use topple::sweep::plan::Plan;
use topple::sweep::request::{BackendRequest, Opened};

use super::numbers::{BaseNumbers, BlockNumbers, RunNumbers, in_order};
use super::{InputError, words};

/// Where to and on what.
#[derive(clap::Args)]
pub struct RunOptions {
    /// Directory for the results; made if need be
    #[arg(long, value_name = "DIR", default_value = "topple-out")]
    pub out: PathBuf,
    /// What to compute on; auto takes a real GPU, else the CPU
    #[arg(long, default_value = "auto")]
    pub backend: BackendRequest,
    /// GPUs to compute on, by their numbers in topple adapters [default: all that are like the best]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    pub adapter: Vec<usize>,
    /// Number type of the sweep
    #[arg(long, default_value = "f32")]
    pub precision: Precision,
    /// Largest step, s
    #[arg(long, value_name = "S", default_value_t = DEFAULT_STEP, allow_negative_numbers = true)]
    pub step: f64,
    /// Run each cell again with half the step and in f64, and mark it unresolved where the outcome
    /// differs
    #[arg(long)]
    pub resolve: bool,
    /// Simulate all of the model and all of the time, also where it has no say in the result
    #[arg(long)]
    pub full_model: bool,
    /// Believe numbers that are not plausible
    #[arg(long)]
    pub force: bool,
    /// Print nothing but warnings and errors
    #[arg(long)]
    pub quiet: bool,
}

/// The largest step that is not questioned, s.
const LARGEST_STEP: f64 = 0.1;

/// What a map has besides.
#[derive(clap::Args)]
pub struct MapOptions {
    #[command(flatten)]
    pub run: RunOptions,
    /// Go on with an interrupted run in the same directory
    #[arg(long)]
    pub resume: bool,
    /// Least time between two writings of what is done, which --resume goes on from, s; a part, and
    /// a map larger than memory, is written tile by tile
    #[arg(long, value_name = "S", default_value = "2", value_parser = seconds, allow_negative_numbers = true)]
    pub keep_every: Duration,
    /// Run the k-th of n parts only, and leave it in the directory for topple merge
    #[arg(long, value_name = "K/N")]
    pub tile: Option<Part>,
    /// Say what the run would take, and run nothing but a sample
    #[arg(long)]
    pub dry_run: bool,
}

impl RunOptions {
    /// The plan of a scene.
    ///
    /// # Errors
    /// Those of [`Manner::plan`].
    pub fn plan(&self, scene: &Scene) -> Result<Plan, SceneError> {
        let step = self.step;
        if step > LARGEST_STEP && !self.force {
            let key = "step";
            let problem = format!(
                "{step} s is not plausible (up to {LARGEST_STEP}; seconds are meant, not \
                 milliseconds); --force believes it"
            );
            return Err(SceneError { key, problem });
        }
        self.manner().plan(scene)
    }

    /// How a scene is run.
    pub fn manner(&self) -> Manner {
        Manner {
            precision: self.precision,
            largest_step: self.step,
            resolve: self.resolve,
            full_model: self.full_model,
        }
    }

    /// Opens what to compute on: one backend, or as many as there are GPUs; all alike.
    ///
    /// # Errors
    /// Those of [`BackendRequest::open`].
    pub fn open_backends(&self) -> anyhow::Result<Vec<Backend>> {
        if !self.adapter.is_empty()
            && matches!(self.backend, BackendRequest::Cpu | BackendRequest::Reference)
        {
            let problem = "--adapter: the CPU has none; give --backend gpu, or leave it out";
            return Err(InputError(problem.into()).into());
        }
        match self.backend.open(self.precision, &self.adapter) {
            Ok(Opened { backends, passed_over }) => {
                let on = if backends[0].adapter().is_some() { "another GPU" } else { "the CPU" };
                for error in &passed_over {
                    words::warn(format!("{error}; computing on {on}"));
                }
                Ok(backends)
            }
            Err(error @ (GpuError::NoSuchAdapter(_) | GpuError::Unlike(..))) => {
                Err(InputError(format!("--adapter: {error}")).into())
            }
            Err(error) => Err(error.into()),
        }
    }
}

/// What a number's values may be, for the help.
pub const VALUES: &str = "VALUES of a number: one value; start:stop:count, both ends included; start:stop:count:log, each \
the same factor larger; or a list a,b,c. Numbers of several values are the axes of the sweep, six at most.";

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
    /// Directions in which the base moves; a locked one needs no period [default: dual]
    #[arg(long, value_name = "DIRECTIONS", help_heading = "Base")]
    isolation: Option<Directions>,
    #[command(flatten)]
    base: BaseNumbers,
    #[command(flatten)]
    run: RunNumbers,
    /// When a block counts as overturned [default: critical-angle]
    #[arg(long, value_name = "WHEN", help_heading = "Run")]
    overturn: Option<Overturn>,
    /// The number along the picture's horizontal axis
    #[arg(long, value_name = "KEY", help_heading = "Run", value_parser = parameter)]
    x: Option<Parameter>,
    /// The number along the picture's vertical axis
    #[arg(long, value_name = "KEY", help_heading = "Run", value_parser = parameter)]
    y: Option<Parameter>,
}

impl CommonFlags {
    /// The scene so far, with other numbers than those that every scene has, and without its excitation.
    pub fn text(
        &self,
        title: Option<&str>,
        more: impl Iterator<Item = (usize, Parameter, Values)>,
    ) -> SceneText {
        let own = self.block.placed().chain(self.base.placed()).chain(self.run.placed());
        SceneText {
            title: title.map(String::from),
            object: self.object,
            isolation: self.isolation,
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

/// A time in seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let parsed = text.parse::<f64>().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    parsed.ok_or_else(|| "must be a number of seconds, 0 or more".into())
}

/// A scene's error in terms of flags.
pub fn flag_error(error: &SceneError) -> InputError {
    InputError(format!("{}: {}", error.flag(), error.problem))
}
