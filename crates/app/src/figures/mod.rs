//! `topple figures`.

mod beyond;
mod maps;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use topple::Written;
use topple::backend::backend_error::BackendError;
use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::cells::clock::Resolution;
use topple::cells::plan::Plan;
use topple::results::files::Directory;
use topple::scene::{Grid, Scene, SceneError};
use topple::stepping::outcome::Outcome;
use topple::sweep::error::SweepError;
use topple_lab::figures::error::ReadError;
use topple_lab::figures::motions::{self, Motion, Motions};
use topple_lab::figures::text::FigureInputs;
use topple_lab::figures::{Figure, Shows, letter};
use topple_pictures::drawing::picture::Picture;

use super::errors::of_figure;
use super::memory;
use super::options::RunOptions;
use super::print::print_line;
use super::progress::Bar;
use super::results_directory;
use super::{InputError, examples, interrupt, load};

/// Most points of an axis.
const MOST: i64 = topple::scene::Range::LARGEST_COUNT as i64;

/// A figure's name and its TOML.
type NamedToml = (String, String);

/// The figures that are part of the binary.
const BUILT_IN: [(&str, &str); 16] = [
    ("fig04", include_str!("../../../../scenes/fig04.toml")),
    ("fig05", include_str!("../../../../scenes/fig05.toml")),
    ("fig06", include_str!("../../../../scenes/fig06.toml")),
    ("fig07", include_str!("../../../../scenes/fig07.toml")),
    ("fig08", include_str!("../../../../scenes/fig08.toml")),
    ("fig09", include_str!("../../../../scenes/fig09.toml")),
    ("fig11", include_str!("../../../../scenes/fig11.toml")),
    ("fig12", include_str!("../../../../scenes/fig12.toml")),
    ("fig13", include_str!("../../../../scenes/fig13.toml")),
    ("fig14", include_str!("../../../../scenes/fig14.toml")),
    ("ground", include_str!("../../../../scenes/ground.toml")),
    ("strip", include_str!("../../../../scenes/strip.toml")),
    ("boundary", include_str!("../../../../scenes/boundary.toml")),
    ("shares", include_str!("../../../../scenes/shares.toml")),
    ("parity", include_str!("../../../../scenes/parity.toml")),
    ("motion", include_str!("../../../../scenes/motion.toml")),
];

/// The motions of the built-in figures.
const MOTIONS: &str = include_str!("../../../../scenes/motions.toml");
/// Name of the motions' file in a directory of scenes.
const MOTIONS_FILE: &str = "motions";

/// Draw the figures of the paper, and further ones.
#[derive(clap::Args)]
#[command(after_help = examples::FIGURES)]
pub struct FiguresCommand {
    /// Only these figures, as in fig12 [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Directory with the records that the figures name; a missing record is replaced by a synthetic one, as the picture says
    #[arg(long, value_name = "DIR", env = "TOPPLE_RECORDS")]
    records: Option<PathBuf>,
    /// Directory with figures and motions.toml, instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    scenes: Option<PathBuf>,
    /// Points of every axis, instead of those of the figures
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST))]
    cells: Option<u32>,
    #[command(flatten)]
    options: RunOptions,
}

impl FiguresCommand {
    /// Makes the figures.
    pub fn run(&self) -> anyhow::Result<()> {
        self.options.set_threads()?;
        if let Some(records) = &self.records
            && !records.is_dir()
        {
            let problem = "no such directory; give the one with the records, or leave it out";
            return Err(InputError(format!("--records: {}: {problem}", records.display())).into());
        }
        let (written, motions) = self.written()?;
        let inputs =
            FigureInputs { motions: &motions, records: self.records.as_deref(), cells: self.cells };
        // All are read before any runs: a mistake in the last shows at once.
        let figures = written
            .iter()
            .map(|(name, text)| Figure::from_toml(name, text, &inputs))
            .collect::<Result<Vec<_>, ReadError>>()
            .map_err(|error| InputError(error.to_string()))?;
        for (figure, _) in &figures {
            let cells = figure.cells();
            memory::fits(memory::of_cells(cells), &format!("{}: {cells} cells", figure.name))?;
            for (k, panel) in figure.panels.iter().enumerate() {
                let place = format!("{}, panel {}", figure.name, letter(k));
                plan(&self.options, &panel.scene, panel.fixed_step, &place)?;
            }
        }
        let work = Work {
            options: &self.options,
            out: results_directory::open(&self.options.out)?,
            // A request opens one backend at least.
            backend: self.options.open_backends()?.swap_remove(0),
        };
        work.say_missing(&figures);
        interrupt::listen();
        for (figure, motions) in &figures {
            if interrupt::asked() {
                return Err(of_figure(BackendError::Cancelled.into()));
            }
            // A figure has panels of one kind: its reader made sure.
            match figure.panels[0].shows {
                Shows::LeastAmplitude => work.boundaries(figure)?,
                Shows::Shares => work.shares(figure)?,
                Shows::Motion => work.motion(figure)?,
                _ => work.maps(figure, motions)?,
            }
        }
        Ok(())
    }

    /// The figures asked for, by name and text, and the motions.
    fn written(&self) -> Result<(Vec<NamedToml>, Motions), InputError> {
        let mut all: Vec<NamedToml> = Vec::new();
        let (mut place, mut motions) = (format!("{MOTIONS_FILE}.toml"), MOTIONS.to_string());
        match &self.scenes {
            None => all.extend(BUILT_IN.map(|(name, text)| (name.into(), text.into()))),
            Some(directory) => {
                for path in tomls(directory)? {
                    let text = read(&path)?;
                    let name = path.file_stem().unwrap_or_default().to_string_lossy().to_string();
                    if name == MOTIONS_FILE {
                        (place, motions) = (path.display().to_string(), text);
                    } else if text.contains(load::FIGURE) {
                        all.push((name, text));
                    }
                }
            }
        }
        let motions =
            motions::from_toml(&place, &motions).map_err(|e| InputError(e.to_string()))?;
        if self.only.is_empty() {
            return Ok((all, motions));
        }
        let mut chosen = Vec::new();
        for name in &self.only {
            match all.iter().find(|(known, _)| same(known, name)) {
                Some(figure) => chosen.push(figure.clone()),
                None => {
                    let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
                    let problem = format!("no figure '{name}'; there are {}", names.join(", "));
                    return Err(InputError(format!("--only: {problem}")));
                }
            }
        }
        Ok((chosen, motions))
    }
}

/// The plan of a scene, by steps of its own or exactly `fixed` ones; `place` names the panel.
fn plan(
    options: &RunOptions,
    scene: &Scene,
    fixed: Option<f64>,
    place: &str,
) -> Result<Plan, InputError> {
    plan_by(options, scene, fixed).map_err(|error| InputError(format!("{place}: {error}")))
}

fn plan_by(options: &RunOptions, scene: &Scene, fixed: Option<f64>) -> Result<Plan, SceneError> {
    match fixed {
        None => options.plan(scene),
        Some(step) => {
            Plan::resolved(scene, Resolution::exactly(step)).map(|plan| plan.full_model())
        }
    }
}

/// What the figures are made with.
struct Work<'a> {
    options: &'a RunOptions,
    out: Directory,
    backend: Backend,
}

impl Work<'_> {
    fn say(&self, line: &str) {
        if !self.options.quiet {
            print_line!("{line}");
        }
    }

    /// Says which components are synthetic, each once.
    fn say_missing(&self, figures: &[(Figure, Vec<Motion>)]) {
        let all = figures.iter().flat_map(|(_, motions)| motions).flat_map(|m| &m.missing);
        let lines: BTreeSet<&String> = all.collect();
        for line in lines {
            self.say(&format!("records    {line}"));
        }
    }

    /// The plan of a scene, as of the sweep.
    fn plan_of(&self, scene: &Scene, fixed: Option<f64>) -> Result<Plan, SweepError> {
        Ok(plan_by(self.options, scene, fixed)?)
    }

    /// Runs the cells of a scene.
    fn sweep(
        &self,
        scene: &Scene,
        fixed: Option<f64>,
        place: &str,
        progress: &Bar,
    ) -> anyhow::Result<Vec<Outcome>> {
        let options = self.options;
        let (plan, grid) = (plan(options, scene, fixed, place)?, Grid::of(scene));
        let run = CellRun::all(&plan, &grid, options.precision()).resolving(options.resolve);
        Ok(self
            .backend
            .run(&run, progress)
            .map_err(|error| of_figure(error.into()))?
            .block
            .to_outcomes())
    }

    /// How the cells were computed, for captions.
    fn how(&self) -> String {
        let method = self.options.method();
        format!(
            "topple {}, {} {}, steps of at most {} s.",
            env!("CARGO_PKG_VERSION"),
            self.backend.name(),
            method.precision.key(),
            method.largest_step
        )
    }

    /// Writes a figure's picture, and says where it is and what it took.
    fn picture(&self, name: &str, picture: &Picture, what: &str) -> anyhow::Result<()> {
        results_directory::write_picture(&self.out, name, picture, &picture.png()?)?;
        self.say(&format!("{name:10} {what}; {}", self.out.file(&format!("{name}.png")).display()));
        Ok(())
    }
}

/// True where two names are the same but for zeros before a number: fig4 and fig04.
fn same(known: &str, given: &str) -> bool {
    let plain = |name: &str| name.to_lowercase().replace("fig0", "fig");
    plain(known) == plain(given)
}

/// The TOML files of a directory, by name.
fn tomls(directory: &Path) -> Result<Vec<PathBuf>, InputError> {
    let refused = |e: std::io::Error| {
        InputError(format!("--scenes: {}: {e}; give a directory of figures", directory.display()))
    };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(directory).map_err(refused)? {
        let path = entry.map_err(refused)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

fn read(path: &Path) -> Result<String, InputError> {
    load::read(path).map_err(|reason| InputError(format!("{}: {reason}", path.display())))
}
