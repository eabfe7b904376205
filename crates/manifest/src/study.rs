//! What the studies of a suite say.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use topple::backend::description::AdapterDescription;
use topple::model::precision::Precision;
use topple::scene::Scene;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::path_text::PathText;
use topple_studies::suites::envelope::{Best, Limits};
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::resample::Resample;
use topple_studies::suites::verified::Verified;
use topple_studies::uncertain::Varied;

use super::CommandLine;
use super::pictures::Pictures;
use super::suite::Sources;

/// What the run of a study says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct StudyRun<Own> {
    /// What every study says.
    #[serde(flatten)]
    pub study: Study,
    /// What this one says.
    #[serde(flatten)]
    pub own: Own,
    /// What the reference says of a sample of cells.
    pub verified: Verified,
}

/// What every study of a suite says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Study {
    /// The scene under the first motion; of a comparison that of the first device.
    pub scene: Option<Scene>,
    /// What the numbers of its device make of the base.
    #[serde(skip_serializing_if = "Option::is_none", skip_deserializing)]
    pub device: Option<DeviceNumbers>,
    /// The path of the suite.
    pub suite: Option<PathText>,
    /// The command that repeats it.
    pub command: Option<CommandLine>,
    /// The suite's motions, each once.
    pub motions: Vec<String>,
    /// True where each motion is taken in both directions, as it is and reversed.
    pub both_directions: bool,
    /// What the motions were read from.
    pub records: Sources,
    /// Why lines of the suite have no motion, by their ids.
    pub left_out: BTreeMap<String, String>,
    /// gpu or cpu, or reference.
    pub backend: Option<String>,
    /// The adapter, for a GPU.
    pub adapter: Option<AdapterDescription>,
    /// Threads of the CPU.
    pub threads: usize,
    // A method, but for its columns: a study has a key of this name.
    /// The numbers of the sweep.
    pub precision: Option<Precision>,
    /// The largest step, s.
    pub largest_step: f64,
    /// Each cell is run again with half the step.
    pub resolve: bool,
    /// No shortcuts are taken.
    pub full_model: bool,
    /// Cells beside boundaries are run again.
    pub repair: bool,
    /// Cells of the grid.
    pub cells: usize,
    /// Time of all sweeps, s.
    pub sweep_seconds: f64,
    /// Cells of all motions by this time.
    pub records_times_cells_per_second: f64,
    /// How its pictures are printed.
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
}

impl Study {
    /// How many motions it has, each direction of one counted.
    pub fn motions(&self) -> usize {
        self.motions.len() * if self.both_directions { 2 } else { 1 }
    }
}

/// What an envelope says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Envelope {
    /// The limits.
    #[serde(flatten)]
    pub limits: Limits,
    /// What makes a feasible cell the best.
    pub best: Best,
    /// How many cells are feasible.
    pub feasible: usize,
    /// The best cell; none if no cell is feasible.
    pub best_cell: Option<usize>,
    /// Columns of a map that are told, too.
    pub columns: Vec<String>,
    /// What the intervals are made of.
    #[serde(flatten)]
    pub drawn: Drawn,
    /// The numbers that are not known.
    #[serde(flatten)]
    pub unknown: Unknown,
}

/// What a fragility says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Fragility {
    /// The intensity measure of the levels.
    pub im: Option<Intensity>,
    /// Levels; none where each motion is as it is.
    pub levels: Option<Vec<f64>>,
    /// The limit states, by their names.
    pub limit_states: Vec<String>,
    /// The estimators, by theirs; the first is the one that is drawn.
    pub estimators: Vec<String>,
    /// What the intervals are made of.
    #[serde(flatten)]
    pub drawn: Drawn,
    /// The numbers that are not known.
    #[serde(flatten)]
    pub unknown: Unknown,
    /// The hazard of the site.
    #[serde(flatten)]
    pub site: Site,
    /// The annual rate that is accepted.
    pub target: Option<f64>,
    /// Runs of which nothing is known: they are left out.
    pub unresolved: usize,
    /// Of a single cell why curves are open, or are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// What a comparison says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Comparison {
    /// The list of devices.
    pub list: Option<PathText>,
    /// Its devices, in their order.
    pub devices: Vec<DeviceRun>,
    /// The limits.
    #[serde(flatten)]
    pub limits: Limits,
    /// Factors on the motions for the reserve.
    pub scales: Vec<f64>,
    /// Columns of a map that are told, too.
    pub columns: Vec<String>,
    /// What the intervals are made of.
    #[serde(flatten)]
    pub drawn: Drawn,
    /// The intensity measure of the levels.
    pub im: Option<Intensity>,
    /// Levels; none where each motion is as it is.
    pub levels: Option<Vec<f64>>,
    /// The hazard of the site.
    #[serde(flatten)]
    pub site: Site,
}

/// A device of a comparison.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DeviceRun {
    /// Its name.
    pub device: String,
    /// Its scene under the first motion.
    pub scene: Scene,
}

/// What intervals are made of.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Drawn {
    /// What is drawn.
    pub resample: Option<Resample>,
    /// Of how many it is drawn.
    pub groups: Option<usize>,
    /// How often.
    pub replicates: Option<u32>,
    /// The seed of what is drawn.
    pub seed: u32,
}

/// Numbers that are not known.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Unknown {
    /// Their distributions.
    pub vary: Vec<Varied>,
    /// The number of points of these.
    pub samples: Option<u32>,
}

/// The hazard of a site, and the files that were read.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Site {
    /// The path of the hazard curve.
    pub hazard: Option<PathText>,
    /// The unit in which its levels were read.
    pub hazard_units: Option<String>,
    /// What it was read from, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hazard_source: Option<String>,
    /// The curve that was read: its levels, in SI units, and annual rates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hazard_curve: Option<Vec<[f64; 2]>>,
    /// Checksums of the files that were read beside the motions, by the flags that name them.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub inputs: BTreeMap<String, String>,
}
