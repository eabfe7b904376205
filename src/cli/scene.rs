//! `topple run`, and `topple` alone.

use std::path::{Path, PathBuf};

use anyhow::Context;
use topple::map::earlier::Kind;
use topple::scene::builder::SceneBuilder;
use topple::scene::record::read::format_of;

use super::again::{self, Again};
use super::options::MapOptions;
use super::words::with_keys;
use super::{InputError, examples, history, run};

/// The scene that `topple` alone runs.
pub const DEFAULT_SCENE: &str = include_str!("../../scenes/default.toml");

/// What only a figure's file has.
pub const FIGURE: &str = "[[panel]]";

/// Largest scene file that is read, bytes.
const LARGEST: u64 = 1 << 20;

/// Run a scene from a file, or an earlier run again.
///
/// Of an earlier run the same scene is run, its record read again from where it lay or beside the results, with
/// the precision, the step and the shortcuts of then where no flag says otherwise.
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
            let Again { kind, scene, method } = earlier.map_err(refused)?;
            let mut options = self.options.clone();
            options.run.adopt(method);
            return match kind {
                Kind::Map => run::run_map(&scene, &options),
                Kind::History => history::run_cell(&scene, &options.run),
                Kind::Suite => Err(refused("a suite is no scene".into()).into()),
            };
        }
        let text = read(&self.scene).map_err(refused)?;
        if let Some(format) = format_of(&text) {
            let problem =
                format!("a record ({format}), not a scene; give it to topple seismic --horizontal");
            return Err(refused(problem).into());
        }
        if text.contains(FIGURE) {
            let problem = "this is a figure of several panels; run it by topple figures --scenes";
            return Err(refused(problem.into()).into());
        }
        let mut scene = SceneBuilder::from_toml(&text).map_err(refused)?;
        scene.force |= self.options.run.force;
        let directory = self.scene.parent().unwrap_or(Path::new(""));
        let scene = scene.check_in(directory).map_err(|e| refused(with_keys(&e.to_string())))?;
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
