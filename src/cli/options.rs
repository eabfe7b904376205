//! Options that every run has.

use std::path::PathBuf;

use topple::scene::SceneError;
use topple::scene::text::RunText;
use topple::scene::text::SceneText;
use topple::scene::{Scene, block::BlockText, excitation::PulseText, isolation::IsolationText};
use topple::sweep::backend::{Backend, Choice, Precision};
use topple::sweep::cells::DEFAULT_STEP;

use super::InputError;

/// Where to and on what.
#[derive(clap::Args)]
pub struct RunOptions {
    /// Directory for the results; made if need be
    #[arg(long, value_name = "DIR", default_value = "topple-out")]
    pub out: PathBuf,
    /// What to compute on; auto takes a real GPU, else the CPU
    #[arg(long, default_value = "auto")]
    pub backend: Choice,
    /// Number type of the sweep
    #[arg(long, default_value = "f32")]
    pub precision: Precision,
    /// Largest step, s
    #[arg(long, value_name = "S", default_value_t = DEFAULT_STEP, allow_negative_numbers = true)]
    pub step: f64,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

impl RunOptions {
    /// Opens the backend.
    pub fn open_backend(&self) -> anyhow::Result<Backend> {
        Ok(Backend::choose(self.backend, self.precision)?)
    }
}

/// A scene given by flags.
#[derive(clap::Args)]
pub struct SceneFlags {
    #[command(flatten, next_help_heading = "Block")]
    block: BlockText,
    #[command(flatten, next_help_heading = "Base")]
    base: IsolationText,
    #[command(flatten, next_help_heading = "Pulse")]
    pulse: PulseText,
    #[command(flatten, next_help_heading = "Simulation")]
    run: RunText,
}

impl SceneFlags {
    /// The checked scene.
    pub fn scene(&self, title: &str) -> Result<Scene, InputError> {
        let text = SceneText {
            title: Some(title.into()),
            block: self.block.clone(),
            base: self.base.clone(),
            pulse: self.pulse.clone(),
            run: self.run.clone(),
        };
        text.check().map_err(|error| flag_error(&error))
    }
}

/// A scene's error in terms of flags.
pub fn flag_error(error: &SceneError) -> InputError {
    InputError(format!("{}: {}", error.flag(), error.problem))
}
