//! The settings of a sweep: on which backend it runs, by which method, and where finished cells are saved.

use std::path::PathBuf;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::backend::request::BackendRequest;
use crate::cells::clock::DEFAULT_STEP;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::column_set::ColumnSet;
use crate::results::columns::Column;
use crate::results::shard::Shard;
use crate::scene::{Parameter, Scene, SceneError};

/// How cells are computed: everything that a map depends on beside its scene and its backend.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Method {
    /// Number type.
    pub precision: Precision,
    /// Largest step, s.
    pub largest_step: f64,
    /// Each cell runs twice, the second time with half the step and in f64. A cell whose outcome changes is unresolved.
    pub resolve: bool,
    /// The shortcuts that cannot change the result are turned off.
    pub full_model: bool,
    /// The cells beside a boundary between outcomes run again in f64 with half the step, and those that change are
    /// replaced.
    #[serde(default)]
    pub repair: bool,
    /// The requested columns. What only other columns need is not computed, and a cell ends when the requested ones are final.
    #[serde(default, skip_serializing_if = "ColumnSet::is_all")]
    pub columns: ColumnSet,
}

impl Default for Method {
    fn default() -> Method {
        let precision = Precision::F32;
        let largest_step = DEFAULT_STEP;
        Method {
            precision,
            largest_step,
            resolve: false,
            full_model: false,
            repair: false,
            columns: ColumnSet::ALL,
        }
    }
}

/// The largest step that is not questioned, s.
const PLAUSIBLE_STEP: f64 = 0.1;

impl Method {
    /// Refuses a step that is not plausible; `force` accepts it.
    ///
    /// # Errors
    /// The key `step`.
    pub fn check_step(&self, force: bool) -> Result<(), SceneError> {
        let step = self.largest_step;
        if step > PLAUSIBLE_STEP && !force {
            let problem = format!(
                "{step} s is not plausible (up to {PLAUSIBLE_STEP}; seconds are meant, not milliseconds); `force` \
                 accepts it"
            );
            return Err(SceneError::new("step", problem));
        }
        Ok(())
    }

    /// Refuses a friction coefficient if no requested column tells where it is too small.
    ///
    /// # Errors
    /// The key `friction`.
    pub fn check_columns(&self, scene: &Scene) -> Result<(), SceneError> {
        if scene.numbers.has(Parameter::Friction) && !self.columns.asked().forces {
            let problem = "marks cells by the friction that they ask for; add friction_demand to the columns, or \
                           leave it out";
            return Err(SceneError::new("friction", problem));
        }
        if self.columns.has(Column::BaseLoad) && !scene.numbers.has(Parameter::Mass) {
            let problem = "base_load is a force, and the mass of the block is not known; give `mass`, or leave base_load out";
            return Err(SceneError::new("columns", problem));
        }
        if self.columns.asked().stops && !scene.numbers.has(Parameter::StopGap) {
            let problem = "the base has no end stop; give `stop_gap` and `stop_stiffness`, or leave stop_force and stop_hits \
                           out";
            return Err(SceneError::new("columns", problem));
        }
        Ok(())
    }

    /// The plan of a scene.
    ///
    /// # Errors
    /// Those of [`Plan::new`], for the shortest steps that a cell runs in by this method.
    pub fn plan(&self, scene: &Scene) -> Result<Plan, SceneError> {
        let plan = Plan::new(scene, self.largest_step)?.asking(self.columns.asked());
        let plan = if self.full_model { plan.full_model() } else { plan };
        self.finest(&plan).check_steps()?;
        Ok(plan)
    }

    /// A plan in the shortest steps that a cell may run in: those of its number type; half of those in f64 where each
    /// cell runs twice; a quarter where repaired cells run a third time. A device without f64 takes longer ones.
    fn finest(&self, plan: &Plan) -> Plan {
        match (self.repair, self.resolve) {
            (true, _) => plan.at(Precision::F64).halved().halved(),
            (false, true) => plan.at(Precision::F64).halved(),
            (false, false) => plan.at(self.precision),
        }
    }
}

/// How much of a sweep the reference runs again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VerifySettings {
    /// Number of cells; 0 means no verification.
    pub cells: usize,
    /// The longest time that it may take; cells that are not done by then are left out.
    pub within: Duration,
}

impl Default for VerifySettings {
    /// 128 cells, or as many as 30 s allow.
    fn default() -> VerifySettings {
        VerifySettings { cells: 128, within: Duration::from_secs(30) }
    }
}

/// Most cells that the reference runs again.
const MOST_VERIFIED: usize = 1 << 20;

impl VerifySettings {
    /// Refuses more cells than are held for it, of so many.
    ///
    /// # Errors
    /// The key `verify`.
    pub fn check(&self, of: usize) -> Result<(), SceneError> {
        let cells = self.cells.min(of);
        if cells > MOST_VERIFIED {
            let problem = format!("{cells} cells are more than {MOST_VERIFIED}; give fewer");
            return Err(SceneError::new("verify", problem));
        }
        Ok(())
    }

    /// The verification that each of a number of sweeps gets when they share this one: at least one cell, unless there are none.
    pub fn shared_out(self, sweeps: usize) -> VerifySettings {
        let sweeps = sweeps.max(1);
        let within = match self.within {
            Duration::MAX => Duration::MAX,
            // Beyond so many sweeps none has time.
            within => within / u32::try_from(sweeps).unwrap_or(u32::MAX),
        };
        VerifySettings { cells: self.cells.div_ceil(sweeps), within }
    }

    /// Verification of `cells` cells, however long they take.
    pub fn cells(cells: usize) -> VerifySettings {
        VerifySettings { cells, within: Duration::MAX }
    }
}

/// How a sweep is run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RunSettings {
    /// What to compute on.
    pub backend: BackendRequest,
    /// GPUs by their numbers; empty: all of the best one's kind.
    pub adapters: Vec<usize>,
    /// How cells are computed.
    pub method: Method,
    /// What the reference runs again.
    pub verify: VerifySettings,
    /// Where finished cells are saved; without it nothing is saved, and the map is held in memory.
    pub saving: Option<Saving>,
}

impl Default for RunSettings {
    fn default() -> RunSettings {
        RunSettings {
            backend: BackendRequest::Auto,
            adapters: Vec::new(),
            method: Method::default(),
            verify: VerifySettings::default(),
            saving: None,
        }
    }
}

/// Where and when finished cells are saved.
#[derive(Debug, Clone, PartialEq)]
pub struct Saving {
    /// The directory; a folder `unfinished`, or a shard's, is made in it.
    pub directory: PathBuf,
    /// True to continue an interrupted run in the directory.
    pub resume: bool,
    /// Least time between two savings.
    pub every: Duration,
    /// Number of bytes that the columns may take in memory, and that the lists of a repair may take besides. The finished cells of
    /// a larger map are only on disk.
    pub memory: u64,
    /// Run only this shard of the grid, and leave it in the directory.
    pub shard: Option<Shard>,
    /// A run that its observer ends does not save what it has done since the last saving: it ends at once.
    pub ends_at_once: bool,
}

/// Bytes that the columns of a map may take in memory by default.
pub const MEMORY: u64 = 1 << 30;

impl Saving {
    /// Saves a whole map in a directory every two seconds, nothing to resume.
    pub fn to(directory: impl Into<PathBuf>) -> Saving {
        Saving {
            directory: directory.into(),
            resume: false,
            every: Duration::from_secs(2),
            memory: MEMORY,
            shard: None,
            ends_at_once: false,
        }
    }
}
