//! `topple pulse`.

use topple::scene::text::SceneText;

use super::numbers::PulseNumbers;
use super::options::{CommonFlags, MapOptions, VALUES, flag_error};
use super::run;

/// Map the outcomes of one-sine pulses over (omega, a_h).
#[derive(clap::Args)]
#[command(after_help = VALUES)]
pub struct PulseCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    pulse: PulseNumbers,
    #[command(flatten, next_help_heading = "Computing")]
    options: MapOptions,
}

impl PulseCommand {
    /// Runs the map.
    pub fn run(&self) -> anyhow::Result<()> {
        let force = self.options.run.force;
        let text = SceneText { force, ..self.common.text(None, self.pulse.placed()) };
        let scene = text.check().map_err(|error| flag_error(&error))?;
        run::run_map(&scene, &self.options)
    }
}
