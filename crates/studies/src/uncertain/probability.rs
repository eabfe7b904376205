//! The probability of each outcome in the cells of a grid: sweeps of the whole grid at many points of what is not known.

use std::io::{self, Write};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::ensemble::Ensemble;
use super::pixel;
use super::points::{shares, values};
use super::varied::Varied;
use crate::several::OneOfSeveral;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::results::csv::Number;
use topple::scene::{Grid, Parameter, Scene, SceneError, Values};
use topple::stepping::outcome::Class;
use topple::sweep::error::SweepError;
use topple::sweep::job::check_held;
use topple::sweep::run::sweep_on;
use topple::sweep::settings::RunSettings;
use topple::work::observer::{Observer, Phase};

/// Most sweeps that tell a probability.
pub const MOST_SAMPLES: u32 = 1 << 20;

/// The numbers of a grid's cells that are not known, and the number of sweeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Parameters of the scene, each with its distribution.
    pub vary: Vec<Varied>,
    /// A cell's axes may have any value in its pixel.
    pub pixel: bool,
    /// Sweeps.
    pub samples: u32,
    /// Seed of their points.
    pub seed: u32,
}

/// The outcomes of the cells of a grid in many sweeps.
#[derive(Debug)]
pub struct Probabilities {
    /// The scene, numbers that vary at their own values.
    pub scene: Scene,
    /// Its grid.
    pub grid: Grid,
    /// How many sweeps there were.
    pub samples: u32,
    /// How often a cell had each outcome, in the order of [`Class::ALL`].
    pub counts: Vec<[u32; 5]>,
    /// The backend that ran them: gpu, cpu or reference.
    pub backend: String,
    /// Seconds of all sweeps together, without the reference.
    pub seconds: f64,
    /// Cells that the reference ran again, of all sweeps together, and those of another outcome.
    pub verified: [usize; 2],
    /// Those of them amid cells of one outcome.
    pub differ_inside: usize,
}

impl Uncertainty {
    /// The points of the sweeps, and the axes that are moved at them. Every scene is checked.
    ///
    /// # Errors
    /// Parameters that cannot vary, too few or too many sweeps, axes without pixels, and numbers that contradict each other.
    pub fn check(&self, scene: &Scene, force: bool) -> Result<Points<'_>, SceneError> {
        // What is wrong with a distribution is said before anything else.
        Ensemble::of(scene, &self.vary, force)?;
        if !(2..=MOST_SAMPLES).contains(&self.samples) {
            let problem = format!("{} is not in 2 to {MOST_SAMPLES}", self.samples);
            return Err(SceneError::new("samples", problem));
        }
        let axes = if self.pixel { pixel::axes(scene)? } else { Vec::new() };
        let shares = shares(self.vary.len() + axes.len(), self.samples as usize, self.seed);
        let points = Points { vary: &self.vary, axes, shares, force };
        for number in 0..points.shares.len() {
            points.scene(scene, number)?;
        }
        Ok(points)
    }
}

/// Points of what is not known.
#[derive(Debug)]
pub struct Points<'a> {
    vary: &'a [Varied],
    axes: Vec<(Parameter, Values)>,
    shares: Vec<Vec<f64>>,
    force: bool,
}

impl Points<'_> {
    /// The scene at a point, by its number.
    ///
    /// # Errors
    /// Those of [`Ensemble`], and of numbers that make no sense together.
    pub fn scene(&self, scene: &Scene, number: usize) -> Result<Scene, SceneError> {
        let shares = &self.shares[number];
        let ensemble = Ensemble::of(scene, self.vary, self.force)?;
        let mut scene = ensemble.scene(&values(self.vary, shares))?;
        if self.axes.is_empty() {
            return Ok(scene);
        }
        for ((parameter, values), share) in self.axes.iter().zip(&shares[self.vary.len()..]) {
            scene.set(*parameter, pixel::moved(values, *share));
        }
        scene.check().map_err(|error| {
            let problem =
                format!("in a pixel `{}` {}; end the axis earlier", error.key, error.problem);
            SceneError::new("pixel", problem)
        })?;
        Ok(scene)
    }
}

impl Probabilities {
    /// Sweeps a scene's grid at every point; the cells of a sweep are counted and forgotten before the next begins.
    /// `settings` tell how each sweep is run, their verification of all sweeps together.
    pub fn run(
        scene: &Scene,
        uncertainty: &Uncertainty,
        force: bool,
        settings: &RunSettings,
        observer: &dyn Observer,
    ) -> Result<Probabilities, SweepError> {
        let points = uncertainty.check(scene, force)?;
        let grid = Grid::of(scene);
        check_held(&grid)?;
        let samples = uncertainty.samples as usize;
        let runs = if settings.method.resolve { 2 } else { 1 };
        observer.begins(Phase::Sweeping, runs * samples * grid.len());
        let method = settings.method;
        let several = OneOfSeveral::of(observer, None);
        let opened = Arc::new(settings.backend.open(method.precision, &settings.adapters)?);
        let mut run = settings.clone();
        (run.verify, run.saving) = (settings.verify.shared_out(samples), None);
        // Nothing else is counted.
        run.method.columns = ColumnSet::of(&[Column::Outcome]);
        let mut all = Probabilities {
            scene: scene.clone(),
            counts: vec![[0; 5]; grid.len()],
            grid,
            samples: uncertainty.samples,
            backend: String::new(),
            seconds: 0.0,
            verified: [0; 2],
            differ_inside: 0,
        };
        for number in 0..samples {
            let scene = points.scene(scene, number)?;
            let map = sweep_on(&opened, &scene, &[], &run, &several)?;
            // Codes are places among the classes.
            for (counts, code) in all.counts.iter_mut().zip(map.column(Column::Outcome)?) {
                counts[code as usize] += 1;
            }
            all.seconds += map.shards.iter().map(|(_, report)| report.sweep).sum::<f64>();
            if let Some((_, report)) = map.shards.first() {
                all.backend.clone_from(&report.backend);
            }
            if let Some(verification) = &map.verification {
                all.verified[0] += verification.sampled;
                all.verified[1] += verification.differ;
                all.differ_inside += verification.differ_inside();
            }
        }
        Ok(all)
    }

    /// The share of the samples in which a cell has an outcome.
    pub fn share(&self, cell: usize, class: Class) -> f64 {
        f64::from(self.counts[cell][class as usize]) / f64::from(self.samples)
    }

    /// The probability that a cell overturns, about either corner.
    pub fn overturns(&self, cell: usize) -> f64 {
        self.share(cell, Class::OverturnedLeft) + self.share(cell, Class::OverturnedRight)
    }

    /// The mean of it over the grid.
    pub fn mean(&self) -> f64 {
        (0..self.counts.len()).map(|cell| self.overturns(cell)).sum::<f64>()
            / self.counts.len() as f64
    }

    /// The share of the cells that have one outcome in all samples.
    pub fn certain(&self) -> f64 {
        let resolved = |counts: &[u32; 5]| {
            Class::ALL
                .iter()
                .zip(counts)
                .any(|(class, count)| *class != Class::Unresolved && *count == self.samples)
        };
        self.counts.iter().filter(|counts| resolved(counts)).count() as f64
            / self.counts.len() as f64
    }

    /// The largest standard error of a cell's probability of overturning, that of independent samples.
    pub fn largest_error(&self) -> f64 {
        let error = |cell| {
            let p = self.overturns(cell);
            (p * (1.0 - p) / f64::from(self.samples)).max(0.0).sqrt()
        };
        (0..self.counts.len()).map(error).fold(0.0, f64::max)
    }

    /// The places of the grid's axes that are axes of the results: a number that varies has no value of its own.
    pub fn axes(&self, uncertainty: &Uncertainty) -> Vec<usize> {
        let varies =
            |parameter| uncertainty.vary.iter().any(|varied| varied.parameter == parameter);
        let axes = self.grid.axes().iter().enumerate();
        axes.filter(|(_, axis)| !varies(axis.parameter)).map(|(place, _)| place).collect()
    }
}

/// Writes probability.csv: the axes, the samples, and the share of each outcome.
pub fn write(all: &Probabilities, uncertainty: &Uncertainty, writer: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(writer);
    let axes = all.axes(uncertainty);
    let keys = axes.iter().map(|place| all.grid.axes()[*place].key());
    table.write_record(keys.chain(["samples"]).chain(Class::ALL.map(Class::name)))?;
    for cell in 0..all.counts.len() {
        let coordinates: Vec<f64> = all.grid.coordinates(cell).collect();
        let coordinates: Vec<Number> =
            axes.iter().map(|place| Number(coordinates[*place])).collect();
        let shares = Class::ALL.map(|class| Number(all.share(cell, class)));
        table.serialize((coordinates, all.samples, shares))?;
    }
    table.flush()
}
