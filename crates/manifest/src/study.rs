//! What the studies of a suite say.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use topple::backend::description::AdapterDescription;
use topple::model::precision::Precision;
use topple::scene::Scene;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::path_text::PathText;
use topple_studies::suites::envelope::Best;
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
    #[serde(flatten)]
    pub study: Study,
    #[serde(flatten)]
    pub own: Own,
    pub verified: Verified,
}

/// What every study of a suite says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Study {
    /// The scene under the first motion; of a comparison that of the first device.
    pub scene: Option<Scene>,
    #[serde(skip_serializing_if = "Option::is_none", skip_deserializing)]
    pub device: Option<DeviceNumbers>,
    pub suite: Option<PathText>,
    pub command: Option<CommandLine>,
    /// The suite's motions, each once.
    pub motions: Vec<String>,
    /// True where each motion is taken in both directions, as it is and reversed.
    pub both_directions: bool,
    pub records: Sources,
    /// Why lines of the suite have no motion, by their ids.
    pub left_out: BTreeMap<String, String>,
    pub backend: Option<String>,
    pub adapter: Option<AdapterDescription>,
    pub threads: usize,
    // A method, but for its columns: a study has a key of this name.
    pub precision: Option<Precision>,
    pub largest_step: f64,
    pub resolve: bool,
    pub full_model: bool,
    pub repair: bool,
    pub cells: usize,
    pub sweep_seconds: f64,
    pub records_times_cells_per_second: f64,
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
    #[serde(flatten)]
    pub limits: Limits,
    pub best: Best,
    pub feasible: usize,
    /// The best cell; none if no cell is feasible.
    pub best_cell: Option<usize>,
    /// Columns of a map that are told, too.
    pub columns: Vec<String>,
    #[serde(flatten)]
    pub drawn: Drawn,
    #[serde(flatten)]
    pub unknown: Unknown,
}

/// What a fragility says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Fragility {
    pub im: Option<Intensity>,
    /// Levels; none where each motion is as it is.
    pub levels: Option<Vec<f64>>,
    pub limit_states: Vec<String>,
    /// The estimators, by theirs; the first is the one that is drawn.
    pub estimators: Vec<String>,
    #[serde(flatten)]
    pub drawn: Drawn,
    #[serde(flatten)]
    pub unknown: Unknown,
    #[serde(flatten)]
    pub site: Site,
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
    pub devices: Vec<DeviceRun>,
    #[serde(flatten)]
    pub limits: Limits,
    /// Factors on the motions for the reserve.
    pub scales: Vec<f64>,
    /// Columns of a map that are told, too.
    pub columns: Vec<String>,
    #[serde(flatten)]
    pub drawn: Drawn,
    pub im: Option<Intensity>,
    /// Levels; none where each motion is as it is.
    pub levels: Option<Vec<f64>>,
    #[serde(flatten)]
    pub site: Site,
}

/// A device of a comparison.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DeviceRun {
    pub device: String,
    pub scene: Scene,
}

/// Limits that a base must keep.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Limits {
    pub standing: Option<f64>,
    pub limit_u: Option<f64>,
    pub limit_v: Option<f64>,
}

/// What intervals are made of.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Drawn {
    pub resample: Option<Resample>,
    pub groups: Option<usize>,
    pub replicates: Option<u32>,
    pub seed: u32,
}

/// Numbers that are not known.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Unknown {
    pub vary: Vec<Varied>,
    pub samples: Option<u32>,
}

/// The hazard of a site, and the files that were read.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Site {
    pub hazard: Option<PathText>,
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
