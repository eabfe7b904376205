//! `topple run`, and `topple` alone.

use std::path::PathBuf;

use anyhow::Context;
use topple::results::earlier::RUN;
use topple::scene::builder::SceneBuilder;
use topple_manifest::Run;

use super::earlier_run::{self, EarlierRun};
use super::given::{GivenFlags, is_of_a_run};
use super::history_table::MoreColumns;
use super::load::load;
use super::options::MapOptions;
use super::uncertain::NOT_BESIDE;
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
    // Before the flags, which are taken away as they are read.
    #[command(flatten)]
    given: GivenFlags,
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
        if let Some(repeated) = repetition::run(&self.scene, &self.options, &self.given) {
            return repeated;
        }
        if let Some(earlier) = earlier_run::at(&self.scene) {
            return self.again(&earlier.map_err(refused)?);
        }
        let scene = load(&self.scene, self.options.run.force)?;
        run::run_map(&scene, &self.options)
    }

    /// Runs the scene of earlier results as they tell, where no flag says otherwise.
    fn again(&self, EarlierRun { scene, manifest }: &EarlierRun) -> anyhow::Result<()> {
        let path = self.scene.display();
        let refused = |reason: String| InputError(format!("{path}: {reason}"));
        let mut options = self.options.clone();
        let Some(manifest) = manifest else {
            words::warn(format!(
                "{path}: it tells the scene, not how it was computed; {RUN} tells --precision, --step, --refine and so on"
            ));
            return run::run_map(scene, &options);
        };
        let is_known = !options.uncertain.asked();
        let meaningless = match &manifest.run {
            Run::History(_) => self.given.find(|name| !is_of_a_run(name) && name != "verbose"),
            Run::Probability(_) if is_known => self.given.find(|name| NOT_BESIDE.contains(&name)),
            _ => None,
        };
        if let Some(flag) = meaningless {
            let problem = format!("{} has no {flag}; leave that out", manifest.kind.name());
            return Err(refused(problem).into());
        }
        for flag in options.adopt(manifest) {
            let problem = format!("{flag} of that run cannot stand beside the flags given");
            words::warn(format!("{path}: {problem}; it is left out"));
        }
        match &manifest.run {
            Run::History(history) => {
                let more = match &*history.more_columns {
                    "" => MoreColumns::default(),
                    names => names.parse().map_err(refused)?,
                };
                return history::run_cell(scene, &more, &options.run);
            }
            Run::Probability(of) => match &of.uncertainty {
                Some(uncertainty) => options.uncertain.adopt(uncertainty.clone()),
                None if is_known => {
                    let problem = "it does not say what was not known; give --vary or --pixel";
                    return Err(refused(problem.into()).into());
                }
                None => {}
            },
            _ => {}
        }
        run::run_map(scene, &options)
    }
}

/// Runs the default scene.
pub fn run_default(options: &MapOptions) -> anyhow::Result<()> {
    // The scene is part of the binary; a test reads it.
    let text = SceneBuilder::from_toml(DEFAULT_SCENE).map_err(anyhow::Error::msg)?;
    let scene = text.check().context("the default scene")?;
    run::run_map(&scene, options)
}
