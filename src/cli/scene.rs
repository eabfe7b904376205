//! `topple run SCENE.toml`, and `topple` alone.

use std::path::{Path, PathBuf};

use anyhow::Context;
use topple::scene::builder::SceneBuilder;

use super::InputError;
use super::options::MapOptions;
use super::run;

/// The scene that `topple` alone runs.
pub const DEFAULT_SCENE: &str = include_str!("../../scenes/default.toml");

/// What only a figure's file has.
pub const FIGURE: &str = "[[panel]]";

/// Largest scene file that is read, bytes.
const LARGEST: u64 = 1 << 20;

/// Run a scene from a TOML file.
#[derive(clap::Args)]
pub struct RunCommand {
    /// The scene
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    #[command(flatten)]
    options: MapOptions,
}

impl RunCommand {
    /// Runs the scene.
    pub fn run(&self) -> anyhow::Result<()> {
        let path = self.scene.display();
        let refused = |reason: String| InputError(format!("{path}: {reason}"));
        let text = read(&self.scene).map_err(refused)?;
        if text.contains(FIGURE) {
            let problem = "this is a figure of several panels; run it by topple figures --scenes";
            return Err(refused(problem.into()).into());
        }
        let mut scene = SceneBuilder::from_toml(&text).map_err(refused)?;
        scene.force |= self.options.run.force;
        let directory = self.scene.parent().unwrap_or(Path::new(""));
        let scene = scene.check_in(directory).map_err(|e| refused(e.to_string()))?;
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

/// Reads a scene's file.
///
/// # Errors
/// What is wrong and what to do.
pub fn read(path: &Path) -> Result<String, String> {
    let refused = |e: std::io::Error| format!("{e}; give a scene that can be read");
    if std::fs::metadata(path).map_err(refused)?.len() > LARGEST {
        return Err("larger than 1 MiB; this is no scene".into());
    }
    std::fs::read_to_string(path).map_err(refused)
}
