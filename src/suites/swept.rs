//! A sweep under every motion of a suite.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::read::Suite;
use crate::results::columns::Column;
use crate::scene::record::Pair;
use crate::scene::{Excitation, Grid, Scene, SceneBuilder, SceneError, excitation};
use crate::stepping::outcome::Class;
use crate::sweep::error::SweepError;
use crate::sweep::observer::{Observer, Phase};
use crate::sweep::progress::Progress;
use crate::sweep::run::sweep;
use crate::sweep::settings::{RunSettings, VerifySettings};
use crate::sweep::verification::Verification;

/// The cells of a grid under every motion of a suite.
#[derive(Debug)]
pub struct SuiteSweep {
    /// The scene under the first motion.
    pub scene: Scene,
    /// Its grid, that of all motions.
    pub grid: Grid,
    /// What became of the cells under each.
    pub motions: Vec<SweptMotion>,
    /// Seconds of all sweeps together, without the reference.
    pub seconds: f64,
}

/// The cells of a grid under a motion, in the grid's order.
#[derive(Debug)]
pub struct SweptMotion {
    /// The motion's id.
    pub id: String,
    /// How much it counts.
    pub weight: f64,
    /// Outcomes.
    pub outcomes: Vec<Class>,
    /// max |u|, m.
    pub max_u: Vec<f32>,
    /// The largest displacement of v from its static position, m.
    pub stroke_v: Vec<f32>,
    /// The rocking index.
    pub zeta: Vec<f32>,
    /// What the reference says of a sample.
    pub verification: Option<Verification>,
}

/// The values of a motion's cells.
pub type Values = fn(&SweptMotion) -> &[f32];

/// How a suite is swept.
#[derive(Debug, Clone)]
pub struct SuiteSettings {
    /// How each sweep is run; its verification is of all of them together.
    pub run: RunSettings,
    /// Each motion is taken twice, its horizontal component in both directions.
    pub both_directions: bool,
}

/// Hears of the cells of all sweeps, and of nothing else.
struct Watch<'a> {
    observer: &'a dyn Observer,
    sweeping: AtomicBool,
}

impl Progress for Watch<'_> {
    fn advance(&self, cells: usize) {
        if self.sweeping.load(Ordering::Relaxed) {
            self.observer.advance(cells);
        }
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl Observer for Watch<'_> {
    fn begins(&self, phase: Phase, _: usize) {
        self.sweeping.store(phase == Phase::Sweeping, Ordering::Relaxed);
    }
}

impl SuiteSweep {
    /// The motions under which the block of a cell stands.
    pub fn standing(&self, cell: usize) -> impl Iterator<Item = &SweptMotion> {
        self.motions.iter().filter(move |motion| motion.outcomes[cell].stands())
    }

    /// Runs a scene, which has no excitation of its own, under every motion of a suite.
    ///
    /// # Errors
    /// Those of [`sweep`]: numbers that make no sense, a backend that failed, an observer that ended it.
    pub fn run(
        scene: &SceneBuilder,
        suite: &Suite,
        settings: &SuiteSettings,
        observer: &dyn Observer,
    ) -> Result<SuiteSweep, SweepError> {
        let mut pairs: Vec<(String, f64, Pair)> = Vec::new();
        for (entry, motion) in suite.motions() {
            let pair = excitation::scaled(motion.pair.clone(), &scene.numbers);
            if settings.both_directions {
                let reversed = format!("{} reversed", entry.id);
                pairs.push((reversed, entry.weight, pair.clone().reversed()));
            }
            pairs.push((entry.id.clone(), entry.weight, pair));
        }
        // What is wrong with the scene is said before anything runs.
        let under = |pair: &Pair| scene.check_under(Excitation::Record(pair.clone()));
        let scenes: Vec<Scene> =
            pairs.iter().map(|(.., pair)| under(pair)).collect::<Result<_, SceneError>>()?;
        let Some(first) = scenes.first().cloned() else {
            let problem = "no motion; give a suite that has one".into();
            return Err(SceneError { key: "suite", problem }.into());
        };
        let grid = Grid::of(&first);
        let runs = if settings.run.method.resolve { 2 } else { 1 };
        observer.begins(Phase::Sweeping, runs * grid.len() * scenes.len());
        let watch = Watch { observer, sweeping: AtomicBool::new(false) };
        let verify = shared_out(settings.run.verify, scenes.len());
        let mut motions = Vec::with_capacity(scenes.len());
        let mut seconds = 0.0;
        for ((id, weight, _), scene) in pairs.into_iter().zip(&scenes) {
            let mut run = settings.run.clone();
            (run.verify, run.saving) = (verify, None);
            let map = sweep(scene, &[], &run, &watch)?;
            seconds += map.parts.iter().map(|(_, report)| report.sweep).sum::<f64>();
            let column = |column| map.column(column);
            let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
            // Codes are places among the classes.
            let class = |code: f64| Class::ALL.get(code as usize).copied();
            let outcomes = column(Column::Outcome)?.into_iter();
            motions.push(SweptMotion {
                id,
                weight,
                outcomes: outcomes.map(|code| class(code).unwrap_or(Class::Unresolved)).collect(),
                max_u: single(column(Column::MaxU)?),
                stroke_v: single(column(Column::StrokeV)?),
                zeta: single(column(Column::Zeta)?),
                verification: map.verification,
            });
        }
        Ok(SuiteSweep { scene: first, grid, motions, seconds })
    }
}

/// The part of a verification that each of so many sweeps has: a cell at least, where there is to be any.
fn shared_out(all: VerifySettings, sweeps: usize) -> VerifySettings {
    let sweeps = sweeps.max(1);
    let within = match all.within {
        Duration::MAX => Duration::MAX,
        // Counts of motions are small.
        within => within / u32::try_from(sweeps).unwrap_or(u32::MAX),
    };
    VerifySettings { cells: all.cells.div_ceil(sweeps), within }
}
