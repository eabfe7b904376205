//! run.json: what a run says of itself. The command writes it, and the command, the report and tests read it, by these types.
//!
//! What an older run does not say has its default. A few facts are only written, since nothing but a person reads them.

mod map;
mod pictures;
mod study;
mod suite;

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use topple::results::earlier::Kind;
use topple::scene::path_text::PathText;
use topple::scene::record::Provenance;
use topple::scene::{Scene, bounded};
use topple_studies::uncertain::Varied;

pub use map::{
    HistoryRun, MapRun, Motion, MotionRead, Origin, ProbabilityRun, Reduced, SceneRun, Steps,
    Timings,
};
pub use pictures::Pictures;
pub use study::{
    Comparison, DeviceRun, Drawn, Envelope, Fragility, Site, Study, StudyRun, Unknown,
};
pub use suite::{Source, Sources, SuiteRun};

/// run.json.
#[derive(Debug, Clone, Serialize)]
pub struct Manifest {
    /// What its files are of.
    pub kind: Kind,
    /// The version of the program that wrote it.
    pub version: String,
    /// The commit from which this program was built, if that is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// When it was written, in UTC.
    pub date: Option<String>,
    /// What the run says.
    #[serde(flatten)]
    pub run: Run,
    /// What it warned of.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The names of the files beside it.
    pub files: Vec<String>,
}

/// What a run of a kind says.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Run {
    /// A map.
    Map(Box<MapRun>),
    /// The motion of one cell.
    History(Box<HistoryRun>),
    /// Probabilities of outcomes.
    Probability(Box<ProbabilityRun>),
    /// A suite of records.
    Suite(Box<SuiteRun>),
    /// An envelope.
    Envelope(Box<StudyRun<Envelope>>),
    /// A fragility.
    Fragility(Box<StudyRun<Fragility>>),
    /// A comparison of devices.
    Comparison(Box<StudyRun<Comparison>>),
}

/// The words of a command, and the directory that its relative paths are in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CommandLine {
    /// The words after the program's name.
    pub arguments: Vec<PathText>,
    /// The working directory.
    pub directory: PathText,
}

/// Of run.json what is the same for every kind.
#[derive(Deserialize)]
struct Common {
    kind: Kind,
    version: String,
    commit: Option<String>,
    date: Option<String>,
    #[serde(default)]
    warnings: Vec<String>,
    files: Vec<String>,
}

impl Manifest {
    /// Reads the text of a run.json.
    pub fn parse(text: &str) -> serde_json::Result<Manifest> {
        let Common { kind, version, commit, date, warnings, files } = serde_json::from_str(text)?;
        let run = match kind {
            Kind::Map => Run::Map(serde_json::from_str(text)?),
            Kind::History => Run::History(serde_json::from_str(text)?),
            Kind::Probability => Run::Probability(serde_json::from_str(text)?),
            Kind::Suite => Run::Suite(serde_json::from_str(text)?),
            Kind::Envelope => Run::Envelope(serde_json::from_str(text)?),
            Kind::Fragility => Run::Fragility(serde_json::from_str(text)?),
            Kind::Comparison => Run::Comparison(serde_json::from_str(text)?),
        };
        Ok(Manifest { kind, version, commit, date, run, warnings, files })
    }

    /// Reads a file.
    ///
    /// # Errors
    /// That it cannot be read, or is no run.json.
    pub fn read(path: &Path) -> Result<Manifest, String> {
        let text = bounded::text(path, bounded::DOCUMENT).map_err(|error| error.to_string())?;
        Manifest::parse(&text).map_err(|error| error.to_string())
    }
}

impl Run {
    /// What its files are of.
    pub fn kind(&self) -> Kind {
        match self {
            Run::Map(_) => Kind::Map,
            Run::History(_) => Kind::History,
            Run::Probability(_) => Kind::Probability,
            Run::Suite(_) => Kind::Suite,
            Run::Envelope(_) => Kind::Envelope,
            Run::Fragility(_) => Kind::Fragility,
            Run::Comparison(_) => Kind::Comparison,
        }
    }

    /// What every study of a suite says; none of other runs.
    pub fn study(&self) -> Option<&Study> {
        match self {
            Run::Envelope(run) => Some(&run.study),
            Run::Fragility(run) => Some(&run.study),
            Run::Comparison(run) => Some(&run.study),
            _ => None,
        }
    }

    /// What a run of one scene says; none of a suite and its studies.
    pub fn of_scene(&self) -> Option<&SceneRun> {
        match self {
            Run::Map(run) => Some(&run.of),
            Run::History(run) => Some(&run.of),
            Run::Probability(run) => Some(&run.of),
            _ => None,
        }
    }

    /// The scene as run, defaults filled in; of a study under the first motion; none of a suite.
    pub fn scene(&self) -> Option<&Scene> {
        match self.of_scene() {
            Some(run) => run.scene.as_ref(),
            None => self.study()?.scene.as_ref(),
        }
    }

    /// Where the record of its scene came from, if it has one that was read from files.
    pub fn record(&self) -> Option<&Provenance> {
        self.of_scene()?.record.as_ref()
    }

    /// What the motions of its suite were read from, by their ids; none without a suite.
    pub fn records(&self) -> Option<&Sources> {
        match self {
            Run::Suite(run) => Some(&run.records),
            _ => Some(&self.study()?.records),
        }
    }

    /// The command that repeats it, of a run of a suite.
    pub fn command(&self) -> Option<&CommandLine> {
        match self {
            Run::Suite(run) => run.command.as_ref(),
            _ => self.study()?.command.as_ref(),
        }
    }

    /// Checksums of the files that a study read beside its motions, by the flags that name them; none of other runs.
    pub fn inputs(&self) -> Option<&BTreeMap<String, String>> {
        match self {
            Run::Fragility(run) => Some(&run.own.site.inputs),
            Run::Comparison(run) => Some(&run.own.site.inputs),
            _ => None,
        }
    }

    /// How its pictures are printed.
    pub fn pictures(&self) -> &Pictures {
        match self {
            Run::Map(run) => &run.of.pictures,
            Run::History(run) => &run.of.pictures,
            Run::Probability(run) => &run.of.pictures,
            Run::Suite(run) => &run.pictures,
            Run::Envelope(run) => &run.study.pictures,
            Run::Fragility(run) => &run.study.pictures,
            Run::Comparison(run) => &run.study.pictures,
        }
    }

    /// The numbers that it did not take as known.
    pub fn varied(&self) -> &[Varied] {
        match self {
            Run::Probability(run) => run.uncertainty.as_ref().map_or(&[], |of| &of.vary),
            Run::Envelope(run) => &run.own.unknown.vary,
            Run::Fragility(run) => &run.own.unknown.vary,
            _ => &[],
        }
    }
}
