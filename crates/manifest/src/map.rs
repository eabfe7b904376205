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

/// What the run of a map says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct MapRun {
    /// A checksum of all that the map depends on; none of a map that was joined.
    pub tag: Option<u32>,
    pub scene: Option<Scene>,
    #[serde(skip_serializing_if = "Option::is_none", skip_deserializing)]
    pub device: Option<DeviceNumbers>,
    /// Where its record came from, if it has one that was read from files.
    pub record: Option<Provenance>,
    pub cells: usize,
    pub resumed_cells: usize,
    /// gpu, cpu or reference; of shards that differ all of them, as in cpu+gpu.
    pub backend: Option<String>,
    /// The adapter, for a GPU, if all shards have run on the same.
    pub adapter: Option<AdapterDescription>,
    pub threads: usize,
    #[serde(flatten)]
    pub method: Option<Method>,
    #[serde(skip_deserializing)]
    pub steps: Steps,
    #[serde(skip_deserializing)]
    pub timings: Timings,
    pub cells_per_second: f64,
    pub outcomes: BTreeMap<String, usize>,
    /// Cells in which the contact force turned tensile, where the model is not valid; none if nobody requested contact
    /// forces.
    pub tensile_cells: Option<usize>,
    /// Cells that ask for more friction than the scene's coefficient, if it has one.
    pub sliding_cells: Option<usize>,
    pub repaired: Option<Repair>,
    pub refined: Option<RefineReport>,
    pub sharpness: Option<Sharpness>,
    #[serde(skip_deserializing)]
    pub model: Option<Reduced>,
    /// The sample that the reference ran again; none before, and where none was requested.
    pub verification: Option<Verification>,
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
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
    #[serde(flatten)]
    pub report: Report,
}

/// Steps of a sweep, s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Steps {
    pub largest: f64,
    pub shortest: f64,
    pub most: u32,
}

/// The model that was run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reduced {
    pub state: Vec<&'static str>,
    /// What is left out where it has no say in the result; all false with --full-model.
    #[serde(rename = "reductions")]
    pub shortcuts: Shortcuts,
    /// Cells that ended early, their results proved final.
    pub proved_cells: usize,
    pub mean_time: f64,
}

/// Seconds of each part of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timings {
    pub start: f64,
    /// The estimate of what the sweep will take, from a sample of cells.
    pub estimate: f64,
    pub sweep: f64,
    pub counting: f64,
    pub drawing: f64,
    pub writing: f64,
    pub verification: Option<f64>,
}

/// What the run of a single cell says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct HistoryRun {
    pub scene: Option<Scene>,
    #[serde(skip_serializing_if = "Option::is_none", skip_deserializing)]
    pub device: Option<DeviceNumbers>,
    pub backend: Option<String>,
    pub record: Option<Provenance>,
    #[serde(flatten)]
    pub method: Option<Method>,
    pub outcome: Option<Motion>,
    /// Columns of history.csv behind those that it has in any case.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub more_columns: String,
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
}

/// The outcome of a single motion: written whole, and read as far as a reader wants it.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Motion {
    Whole(Box<Outcome>),
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
    pub class: Option<Class>,
    pub impacts: Option<u32>,
    pub t_end: Option<f64>,
    pub max_u: Option<f64>,
    pub stroke_v: Option<f64>,
    /// Least normal contact force over M, m/s^2.
    pub min_contact: Option<f64>,
    pub acc_block: Option<f64>,
    pub base_load: Option<f64>,
}

/// What the run of many sweeps says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ProbabilityRun {
    /// The scene, numbers that vary at their own values.
    pub scene: Option<Scene>,
    pub record: Option<Provenance>,
    #[serde(flatten)]
    pub uncertainty: Option<Uncertainty>,
    pub backend: Option<String>,
    #[serde(flatten)]
    pub method: Option<Method>,
    pub cells: usize,
    pub sweep_seconds: f64,
    pub cells_per_second: f64,
    pub mean_probability: Option<f64>,
    /// Share of the cells that have one outcome in all samples.
    pub certain: f64,
    pub largest_standard_error: f64,
    /// Cells that the reference ran again, and those of another outcome.
    pub verified: [usize; 2],
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
}
