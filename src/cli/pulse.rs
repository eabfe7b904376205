//! `topple pulse`.

use topple::scene::excitation::PulseText;
use topple::scene::text::SceneText;

use super::options::{CommonFlags, MapOptions, flag_error};
use super::run;

/// Map the outcomes of one-sine pulses over (omega, a_h).
#[derive(clap::Args)]
pub struct PulseCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten, next_help_heading = "Pulse")]
    pulse: PulseText,
    #[command(flatten, next_help_heading = "Run")]
    options: MapOptions,
}

impl PulseCommand {
    /// Runs the map.
    pub fn run(&self) -> anyhow::Result<()> {
        let text = SceneText { pulse: Some(self.pulse.clone()), ..self.common.text(None) };
        let scene = text.check().map_err(|error| flag_error(&error))?;
        run::run_map(&scene, &self.options)
    }
}
