//! `topple pulse`.

use topple::scene::builder::SceneBuilder;

use super::numbers::PulseFlags;
use super::options::{CommonFlags, MapOptions, flag_error};
use super::save::save;
use super::{examples, run};

/// Map the outcomes of pulses over any of their numbers, for example (omega, a_h).
#[derive(clap::Args)]
#[command(after_help = examples::PULSE)]
pub struct PulseCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    pulse: PulseFlags,
    #[command(flatten, next_help_heading = "Computing")]
    options: MapOptions,
}

impl PulseCommand {
    /// Runs the map.
    pub fn run(&self) -> anyhow::Result<()> {
        let force = self.options.run.force;
        let text = self.common.text(None, self.pulse.numbers.placed());
        let text = SceneBuilder { force, shape: self.pulse.shape, ..text };
        let scene = text.check().map_err(|error| flag_error(&error))?;
        if let Some(path) = &self.common.save_scene {
            return save(path, text, "run");
        }
        run::run_map(&scene, &self.options)
    }
}
