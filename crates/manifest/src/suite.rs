//! What is said of a set of records.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use topple::backend::description::AdapterDescription;
use topple::model::precision::Precision;
use topple::scene::path_text::PathText;
use topple::scene::record::Provenance;
use topple_studies::Suite;
use topple_studies::suites::measures::Measures;
use topple_studies::suites::{Entry, Motion};

use super::CommandLine;
use super::pictures::Pictures;

/// What the run of `topple suite` says.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SuiteRun {
    /// The path of the suite.
    pub suite: Option<PathText>,
    /// The command that repeats it.
    pub command: Option<CommandLine>,
    /// How many motions it has.
    pub motions: usize,
    /// Of how many recordings they are.
    pub recordings: Option<usize>,
    /// Of how many earthquakes, where that of each motion is known.
    pub events: Option<usize>,
    /// What the motions were read from.
    pub records: Sources,
    /// Why lines have no motion, by their ids.
    pub left_out: BTreeMap<String, String>,
    /// Files that are no part of any line, each with what it is.
    pub unused: BTreeMap<String, String>,
    /// What computed the measures.
    pub backend: Option<String>,
    /// Its adapter, if it is a GPU.
    pub adapter: Option<AdapterDescription>,
    /// Threads of the CPU.
    pub threads: usize,
    /// The numbers of the measures.
    pub precision: Option<Precision>,
    /// How its pictures are printed.
    #[serde(skip_serializing_if = "Pictures::is_plain")]
    pub pictures: Pictures,
}

/// Where the motions of a suite came from, by their ids.
pub type Sources = BTreeMap<String, Source>;

/// Where a motion came from, and how strong it is after scaling.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Source {
    /// Its files.
    #[serde(flatten)]
    pub files: Option<Provenance>,
    /// Its earthquake; empty where that is not known.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub event: String,
    /// Its station; empty where that is not known.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub station: String,
    /// The factor on its samples.
    pub scale: f64,
    /// Its weight among the motions.
    pub weight: f64,
    /// Largest horizontal acceleration, m/s^2.
    pub pga_h: f64,
    /// Largest vertical acceleration, m/s^2.
    pub pga_v: f64,
    /// Largest horizontal velocity, m/s.
    pub pgv: f64,
}

impl Source {
    /// Those of a suite's motions.
    pub fn of(suite: &Suite) -> Sources {
        let of = |(entry, motion): (&Entry, &Motion)| {
            let Measures { pga_h, pga_v, pgv, .. } = motion.measures;
            let source = Source {
                files: motion.pair.provenance.as_deref().cloned(),
                event: entry.event.clone(),
                station: entry.station.clone(),
                scale: entry.scale,
                weight: entry.weight,
                pga_h,
                pga_v,
                pgv,
            };
            (entry.id.clone(), source)
        };
        suite.motions().map(of).collect()
    }
}
