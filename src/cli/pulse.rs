//! `topple pulse`.

use super::options::{RunOptions, SceneFlags};
use super::report;

/// Map the outcomes of one-sine pulses over (omega, a_h).
#[derive(clap::Args)]
pub struct PulseCommand {
    #[command(flatten)]
    scene: SceneFlags,
    #[command(flatten, next_help_heading = "Run")]
    options: RunOptions,
}

impl PulseCommand {
    /// Runs the map.
    pub fn run(&self) -> anyhow::Result<()> {
        let scene = self.scene.scene("Overturning spectral map")?;
        report::run_map(&scene, &self.options)
    }
}
