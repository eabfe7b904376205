//! What the run of one scene says: a map, the motion of one cell, or the outcomes of many sweeps.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize};
use topple::backend::description::AdapterDescription;
use topple::backend::report::Report;
use topple::cells::shortcuts::Shortcuts;
use topple::refine::report::RefineReport;
use topple::scene::Scene;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::path_text::PathText;
use topple::scene::record::Provenance;
use topple::stepping::outcome::{Class, Outcome};
use topple::sweep::repaired::Repair;
use topple::sweep::settings::Method;
use topple::sweep::verification::Verification;
use topple_studies::Sharpness;
use topple_studies::uncertain::Uncertainty;

use super::pictures::Pictures;

/// What is said of a run of one scene, whatever came of it.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SceneRun {
    /// The scene as run, defaults filled in; numbers that vary at their own values.
    pub scene: Option<Scene>,
    /// What the numbers of its device make of the base.
    #[serde(skip_serializing_if = "Option::is_none", skip_deserializing)]
    pub device: Option<DeviceNumbers>,
    /// Where its record came from, if it has one that was read from files.
    pub record: Option<Provenance>,
    /// gpu, cpu or reference; of shards that differ all of them, as in cpu+gpu.
    pub backend: Option<String>,
    /// How its cells are computed.
    #[serde(flatten)]
    pub method: Option<Method>,
    /// How its pictures are printed.
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
}

impl SceneRun {
    /// That of a scene.
    pub fn of(scene: &Scene, backend: String, method: Method, pictures: Pictures) -> SceneRun {
        SceneRun {
            scene: Some(scene.clone()),
            device: DeviceNumbers::of(scene),
            record: scene.excitation.provenance().cloned(),
            backend: Some(backend),
            method: Some(method),
            pictures,
        }
    }
}

/// What the run of a map says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct MapRun {
    /// A checksum of all that the map depends on; none of a map that was joined.
    pub tag: Option<u32>,
    /// What was run, and how.
    #[serde(flatten)]
    pub of: SceneRun,
    /// Cells of the grid.
    pub cells: usize,
    /// Of them those that an interrupted run had saved.
    pub resumed_cells: usize,
    /// The adapter, for a GPU, if all shards have run on the same.
    pub adapter: Option<AdapterDescription>,
    /// Threads of the CPU.
    pub threads: usize,
    /// The steps of its cells.
    #[serde(skip_deserializing)]
    pub steps: Steps,
    /// How long each part took.
    #[serde(skip_deserializing)]
    pub timings: Timings,
    /// Cells that were not resumed by the seconds of the sweep.
    pub cells_per_second: f64,
    /// How many cells have each outcome, by its name.
    pub outcomes: BTreeMap<String, usize>,
    /// Cells in which the contact force turned tensile, where the model is not valid; none if nobody requested contact
    /// forces.
    pub tensile_cells: Option<usize>,
    /// Cells that ask for more friction than the scene's coefficient, if it has one.
    pub sliding_cells: Option<usize>,
    /// What the repair changed, where it was requested.
    pub repaired: Option<Repair>,
    /// How it was refined, where that was requested.
    pub refined: Option<RefineReport>,
    /// How sharp its boundaries are, where that was requested.
    pub sharpness: Option<Sharpness>,
    /// The model that was run.
    #[serde(skip_deserializing)]
    pub model: Option<Reduced>,
    /// The sample that the reference ran again; none before, and where none was requested.
    pub verification: Option<Verification>,
    /// Columns and rows of the pictures: fewer than the grid's where that is very fine.
    pub drawn: (usize, usize),
    /// Which cells came from where; cells are numbered row by row, the horizontal axis fastest.
    pub parts: Vec<Origin>,
}

/// A run of cells and what ran them.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Origin {
    /// The shard's folder; none for what this run ran.
    pub folder: Option<PathText>,
    /// Its cells, and what ran them.
    #[serde(flatten)]
    pub report: Report,
}

/// Steps of a sweep, s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Steps {
    /// The largest that is allowed.
    pub largest: f64,
    /// The shortest of all cells.
    pub shortest: f64,
    /// The most steps of a cell: a number, no time.
    pub most: u32,
}

/// The model that was run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reduced {
    /// The names of its variables.
    pub state: Vec<&'static str>,
    /// What is left out where it has no say in the result; all false with --full-model.
    #[serde(rename = "reductions")]
    pub shortcuts: Shortcuts,
    /// Cells that ended early, their results proved final.
    pub proved_cells: usize,
    /// Mean of the times that cells are simulated, s.
    pub mean_time: f64,
}

/// Seconds of each part of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timings {
    /// To make ready what computes.
    pub start: f64,
    /// The estimate of what the sweep will take, from a sample of cells.
    pub estimate: f64,
    /// The sweep itself.
    pub sweep: f64,
    /// To count outcomes.
    pub counting: f64,
    /// To draw the pictures.
    pub drawing: f64,
    /// To write all files, at the same time.
    pub writing: f64,
    /// The second computation by the reference; none where none was requested.
    pub verification: Option<f64>,
}

/// What the run of a single cell says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct HistoryRun {
    /// What was run, and how.
    #[serde(flatten)]
    pub of: SceneRun,
    /// What became of the block.
    pub outcome: Option<Motion>,
    /// Columns of history.csv behind those that it has in any case.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub more_columns: String,
}

/// The outcome of a single motion: written whole, and read as far as a reader wants it.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Motion {
    /// As it is written.
    Whole(Box<Outcome>),
    /// As it is read.
    Read(MotionRead),
}

impl<'de> Deserialize<'de> for Motion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Motion, D::Error> {
        MotionRead::deserialize(deserializer).map(Motion::Read)
    }
}

/// What is read of an [`Outcome`]. A number that is not known is none.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct MotionRead {
    /// What became of the block.
    pub class: Option<Class>,
    /// How many impacts there were.
    pub impacts: Option<u32>,
    /// When the motion ended, s.
    pub t_end: Option<f64>,
    /// Largest |u|, m.
    pub max_u: Option<f64>,
    /// Stroke of v, m.
    pub stroke_v: Option<f64>,
    /// Least normal contact force over M, m/s^2.
    pub min_contact: Option<f64>,
    /// Largest horizontal acceleration of the block's centre, absolute, m/s^2.
    pub acc_block: Option<f64>,
    /// Largest vertical force that the base carries, N.
    pub base_load: Option<f64>,
}

/// What the run of many sweeps says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ProbabilityRun {
    /// What was run, and how.
    #[serde(flatten)]
    pub of: SceneRun,
    /// What is not known.
    #[serde(flatten)]
    pub uncertainty: Option<Uncertainty>,
    /// Cells of the grid.
    pub cells: usize,
    /// Time of all sweeps, s.
    pub sweep_seconds: f64,
    /// Cells of all sweeps by this time.
    pub cells_per_second: f64,
    /// Mean over the grid of the probability that the block overturns.
    pub mean_probability: Option<f64>,
    /// Share of the cells that have one outcome in all samples.
    pub certain: f64,
    /// Largest standard error of a probability of overturning, that of independent samples.
    pub largest_standard_error: f64,
    /// Cells that the reference ran again, and those of another outcome.
    pub verified: [usize; 2],
}
