//! A sweep under every motion of a suite, each at all its levels.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use super::gather;
use super::saved::SavedMotions;
use super::settings::SuiteSettings;
use super::swept_motion::SweptMotion;
use super::verified::Verified;
use super::wanted::WantedMotion;
use topple::backend::description::AdapterDescription;
use topple::backend::request::OpenBackends;
use topple::scene::grid::Axis;
use topple::scene::{Grid, Parameter, Scene, SceneBuilder, SceneError};
use topple::sweep::error::SweepError;
use topple::sweep::settings::{RunSettings, VerifySettings};

/// The cells of a grid under every motion of a suite.
#[derive(Debug)]
pub struct SuiteSweep {
    /// The scene under the first motion.
    pub scene: Scene,
    /// Its grid, that of all motions.
    pub grid: Grid,
    /// The outcomes of the cells under each.
    pub motions: Vec<SweptMotion>,
    /// Motions of which there was an earlier run's word.
    pub resumed: usize,
    /// gpu, cpu or reference.
    pub backend: &'static str,
    /// The adapter, for a GPU.
    pub adapter: Option<AdapterDescription>,
    /// Seconds of all sweeps together, without the reference.
    pub seconds: f64,
    /// The reference's results for samples.
    pub verified: Verified,
    /// Where the motions are saved; nowhere without a directory.
    pub(super) saved: Option<SavedMotions>,
}

impl SuiteSweep {
    /// The cells in which the block stands under some motion, at some level, though max |u| is beyond the radius of the friction
    /// pendulum, with the largest such max |u|.
    pub fn beyond_radius(&self) -> (usize, f64) {
        let beyond = |cell: usize| {
            let radius = self.grid.value(Parameter::Radius, cell)?;
            let of = |motion: &SweptMotion| {
                let runs = motion.outcomes.iter().zip(&motion.max_u).skip(cell);
                let runs = runs.step_by(self.grid.len()).filter(|(class, _)| class.stands());
                runs.fold(0.0, |most: f64, (_, u)| most.max(f64::from(*u)))
            };
            let most = self.motions.iter().map(of).fold(0.0, f64::max);
            (most > radius).then_some(most)
        };
        let cells = (0..self.grid.len()).filter_map(beyond);
        cells.fold((0, 0.0), |(count, most), u| (count + 1, most.max(u)))
    }
}

/// Most cells of all motions and levels together, 3.5 GiB with what is kept of each.
pub const MOST_CELLS: usize = 1 << 28;
/// Most sweeps: motions, each at every point of what is not known.
pub const MOST_SWEEPS: usize = 1 << 20;

/// A scene under a suite, ready to run.
pub struct SuiteJob {
    /// The scene under the first motion.
    pub scene: Scene,
    /// Its grid, that of all motions.
    pub grid: Grid,
    /// Each motion with the scene under it.
    pub(super) all: Vec<(WantedMotion, Scene)>,
    pub(super) settings: SuiteSettings,
    pub(super) opened: Arc<OpenBackends>,
}

impl SuiteJob {
    /// How the cells of a motion are swept: nothing of a single sweep is verified or saved, and only what a motion keeps is
    /// asked for.
    pub(super) fn sweep_settings(&self) -> RunSettings {
        let mut settings = self.settings.run.clone();
        (settings.verify, settings.saving) = (VerifySettings::cells(0), None);
        settings.method.columns = gather::columns(&self.settings.others);
        settings
    }

    /// Makes a scene, which has no excitation of its own, ready to run under motions.
    ///
    /// # Errors
    /// Numbers that make no sense, more cells than are held, a backend that cannot be had.
    pub fn open(
        scene: &SceneBuilder,
        wanted: Vec<WantedMotion>,
        settings: SuiteSettings,
    ) -> Result<SuiteJob, SweepError> {
        SuiteJob::of_scenes(vec![(scene, wanted)], settings)
    }

    /// The same of several scenes, each with motions of its own, one scene after the other. Their grids have as many cells.
    pub fn of_scenes(
        scenes: Vec<(&SceneBuilder, Vec<WantedMotion>)>,
        settings: SuiteSettings,
    ) -> Result<SuiteJob, SweepError> {
        let under = |(scene, wanted): (&SceneBuilder, WantedMotion)| {
            let under = wanted.under(scene)?;
            Ok((wanted, under))
        };
        let wanted: Vec<(&SceneBuilder, WantedMotion)> = scenes
            .into_iter()
            .flat_map(|(scene, wanted)| wanted.into_iter().map(move |wanted| (scene, wanted)))
            .collect();
        let Some((scene, first)) = wanted.first() else {
            let problem = "no motion; give a suite that has one".into();
            return Err(SceneError { key: "suite", problem }.into());
        };
        // As it is given: its own value describes what varies.
        let first = WantedMotion { settings: Vec::new(), ..first.clone() }.under(scene)?;
        let grid = Grid::of(&first);
        check_size(&grid, &wanted, &settings)?;
        // What is wrong with the scene is said before anything runs.
        let all: Vec<(WantedMotion, Scene)> =
            wanted.into_iter().map(under).collect::<Result<_, SceneError>>()?;
        let run = &settings.run;
        let opened = Arc::new(run.backend.open(run.method.precision, &run.adapters)?);
        Ok(SuiteJob { scene: first, grid, all, settings, opened })
    }

    /// The backend that runs its cells, and GPUs that were passed over.
    pub fn backends(&self) -> &OpenBackends {
        &self.opened
    }

    /// The scenes under their first motions, as many as have the same number of motions.
    pub fn scenes(&self, count: usize) -> Vec<Scene> {
        let each = (self.all.len() / count.max(1)).max(1);
        self.all.iter().step_by(each).map(|(_, scene)| scene.clone()).collect()
    }

    /// Cells of all sweeps that are to run together.
    pub fn cells(&self) -> usize {
        let cells = |(wanted, _): &(WantedMotion, Scene)| wanted.factors.len() * self.grid.len();
        self.all[self.motions()].iter().map(cells).sum()
    }

    /// The motions that are to run: all, or those of a shard.
    pub fn motions(&self) -> Range<usize> {
        let count = self.all.len();
        self.settings.shard.map_or(0..count, |shard| shard.cells(count))
    }
}

/// Refuses more than the memory holds: of the cells what is kept, and of the scenes their axes.
fn check_size(
    grid: &Grid,
    wanted: &[(&SceneBuilder, WantedMotion)],
    settings: &SuiteSettings,
) -> Result<(), SceneError> {
    let refused = |problem| Err(SceneError::new("suite", problem));
    let sweeps = wanted.len();
    if sweeps > MOST_SWEEPS {
        return refused(format!("{sweeps} sweeps are more than {MOST_SWEEPS}; give fewer motions"));
    }
    let own = settings.shard.map_or(0..sweeps, |shard| shard.cells(sweeps));
    let levels: usize = wanted[own].iter().map(|(_, wanted)| wanted.factors.len()).sum();
    let cells = grid.len().saturating_mul(levels);
    let axes: usize = grid.axes().iter().map(Axis::count).sum();
    if cells.max(axes.saturating_mul(sweeps)) > MOST_CELLS {
        return refused(format!(
            "{cells} cells of {sweeps} motions and their levels are more than {MOST_CELLS}; give fewer points or levels"
        ));
    }
    settings.run.verify.check(cells)
}

impl SuiteSweep {
    /// Takes away what was saved while it ran: its results are written. Until then no other run begins in the directory.
    pub fn discard_saved(&mut self) -> io::Result<()> {
        self.saved.take().map_or(Ok(()), SavedMotions::discard)
    }

    /// The motions under which the block of a cell stands, at their first level.
    pub fn standing(&self, cell: usize) -> impl Iterator<Item = &SweptMotion> {
        self.motions.iter().filter(move |motion| motion.outcomes[cell].stands())
    }
}
