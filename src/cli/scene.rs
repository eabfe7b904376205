//! `topple run`, and `topple` alone.

use std::path::PathBuf;

use anyhow::Context;
use topple::map::earlier::Kind;
use topple::scene::builder::SceneBuilder;

use super::again::{self, Again};
use super::load::load;
use super::options::MapOptions;
use super::{InputError, examples, history, run};

/// The scene that `topple` alone runs.
pub const DEFAULT_SCENE: &str = include_str!("../../scenes/default.toml");

/// Run a scene from a file, or an earlier run again.
///
/// Of an earlier run the same scene is run, its record read again from where it lay or beside the results, on
/// the same backend (cpu or reference), with the same precision, step and shortcuts where no flag says otherwise.
#[derive(clap::Args)]
#[command(after_help = examples::RUN)]
pub struct RunCommand {
    /// A scene's file (TOML); a run.json, a map or a directory of results
    #[arg(value_name = "SCENE.toml|RESULTS")]
    scene: PathBuf,
    #[command(flatten)]
    options: MapOptions,
}

impl RunCommand {
    /// Runs the scene.
    pub fn run(&self) -> anyhow::Result<()> {
        let path = self.scene.display();
        let refused = |reason: String| InputError(format!("{path}: {reason}"));
        if let Some(earlier) = again::at(&self.scene) {
            let Again { kind, scene, method, backend, uncertainty } = earlier.map_err(refused)?;
            let mut options = self.options.clone();
            options.adopt(backend.as_deref(), method);
            match uncertainty {
                Some(uncertainty) => options.uncertain.adopt(uncertainty),
                None if kind == Kind::Probability && !options.uncertain.asked() => {
                    let problem = "it does not say what was not known; give --vary or --pixel";
                    return Err(refused(problem.into()).into());
                }
                None => {}
            }
            return match kind {
                Kind::History => history::run_cell(&scene, &options.run),
                _ => run::run_map(&scene, &options),
            };
        }
        let scene = load(&self.scene, self.options.run.force)?;
        run::run_map(&scene, &self.options)
    }
}

/// Runs the default scene.
pub fn run_default(options: &MapOptions) -> anyhow::Result<()> {
    // The scene is part of the binary; a test reads it.
    let text = SceneBuilder::from_toml(DEFAULT_SCENE).map_err(anyhow::Error::msg)?;
    let scene = text.check().context("the default scene")?;
    run::run_map(&scene, options)
}
