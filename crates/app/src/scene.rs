//! `topple run`, and `topple` alone.

use std::path::PathBuf;

use anyhow::Context;
use topple::results::earlier::{Kind, RUN};
use topple::scene::builder::SceneBuilder;

use super::earlier_run::{self, EarlierRun};
use super::history_table::MoreColumns;
use super::load::load;
use super::options::MapOptions;
use super::{InputError, examples, history, repetition, run, words};

/// The scene that `topple` alone runs.
pub const DEFAULT_SCENE: &str = include_str!("../../../scenes/default.toml");

/// Run a scene from a file, or repeat an earlier run.
///
/// An earlier run is repeated with the same scene, backend (cpu or reference), precision, step, shortcuts, repair, refinement,
/// sharpness, files and pictures, unless a flag says otherwise. Its record is looked for at its old place and beside the
/// results. map.npz and map.zarr contain only the scene. An envelope, a fragility or a comparison is repeated by its own
/// command; its suite, hazard curve and list of devices are looked for at their old places, beside the results and in the
/// current directory.
#[derive(clap::Args)]
#[command(after_help = examples::RUN)]
pub struct RunCommand {
    /// Scene file (TOML), or a run.json, a map or a directory of results, to repeat that run
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
        if let Some(repeated) = repetition::at(&self.scene) {
            return repeated.map_err(refused)?.run(&self.options);
        }
        if let Some(earlier) = earlier_run::at(&self.scene) {
            let EarlierRun { kind, scene, method, backend, uncertainty, besides } =
                earlier.map_err(refused)?;
            let mut options = self.options.clone();
            let meaningless = match kind {
                Kind::History => options.not_of_a_history(),
                Kind::Probability if !options.uncertain.asked() => options.of_a_map(),
                _ => Vec::new(),
            };
            if let [flag, ..] = meaningless[..] {
                let problem = format!("{} has no {flag}; leave that out", kind.name());
                return Err(refused(problem).into());
            }
            if method.is_none() {
                let problem = format!(
                    "it tells the scene, not how it was computed; {RUN} tells --precision, --step, --refine and so on"
                );
                words::warn(format!("{path}: {problem}"));
            }
            for flag in options.adopt(backend.as_deref(), method, &besides) {
                let problem = format!("{flag} of that run cannot stand beside the flags given");
                words::warn(format!("{path}: {problem}; it is left out"));
            }
            match uncertainty {
                Some(uncertainty) => options.uncertain.adopt(uncertainty),
                None if kind == Kind::Probability && !options.uncertain.asked() => {
                    let problem = "it does not say what was not known; give --vary or --pixel";
                    return Err(refused(problem.into()).into());
                }
                None => {}
            }
            return match kind {
                Kind::History => {
                    let more = match &*besides.more_columns {
                        "" => MoreColumns::default(),
                        names => names.parse().map_err(refused)?,
                    };
                    history::run_cell(&scene, &more, &options.run)
                }
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
