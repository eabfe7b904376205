//! Options that every run has.

use std::path::PathBuf;
use std::time::Duration;

use topple::scene::block::BlockText;
use topple::scene::isolation::IsolationText;
use topple::scene::text::{RunText, SceneText};
use topple::scene::{Scene, SceneError};
use topple::store::identity::Manner;
use topple::store::part::Part;
use topple::sweep::backend::{Backend, Precision};
use topple::sweep::choice::{Choice, Opened};
use topple::sweep::clock::DEFAULT_STEP;
use topple::sweep::gpu::GpuError;
use topple::sweep::plan::Plan;

use super::{InputError, words};

/// Where to and on what.
#[derive(clap::Args)]
pub struct RunOptions {
    /// Directory for the results; made if need be
    #[arg(long, value_name = "DIR", default_value = "topple-out")]
    pub out: PathBuf,
    /// What to compute on; auto takes a real GPU, else the CPU
    #[arg(long, default_value = "auto")]
    pub backend: Choice,
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
    /// Print nothing but warnings and errors
    #[arg(long)]
    pub quiet: bool,
}

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
    /// Those of [`Choice::open`].
    pub fn open_backends(&self) -> anyhow::Result<Vec<Backend>> {
        if !self.adapter.is_empty() && matches!(self.backend, Choice::Cpu | Choice::Reference) {
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

/// The flags that every scene has.
#[derive(clap::Args)]
pub struct CommonFlags {
    #[command(flatten, next_help_heading = "Block")]
    block: BlockText,
    #[command(flatten, next_help_heading = "Base")]
    base: IsolationText,
    #[command(flatten, next_help_heading = "Simulation")]
    run: RunText,
}

impl CommonFlags {
    /// The scene so far, without its excitation.
    pub fn text(&self, title: Option<&str>) -> SceneText {
        SceneText {
            title: title.map(String::from),
            block: self.block.clone(),
            base: self.base.clone(),
            pulse: None,
            record: None,
            run: self.run.clone(),
        }
    }
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
