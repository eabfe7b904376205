//! What a suite's sweep will take, from a sample of its motions.

use std::time::Instant;

use super::swept::SuiteJob;
use super::wanted::WantedMotion;
use topple::scene::{Parameter, Scene};
use topple::sweep::error::SweepError;
use topple::sweep::estimate::Estimate;
use topple::sweep::run::sweep_on;
use topple::work::observer::Observer;

/// Motions of the sample.
const MOTIONS: usize = 5;
/// Cells of a motion that are all run for the sample.
const FEW: usize = 20_000;

impl SuiteJob {
    /// Seconds that all its cells will take. Long motions take longer: the time of a cell is estimated from a motion's samples.
    ///
    /// # Errors
    /// Those of the backend, and that it was cancelled.
    pub fn estimate(&self, observer: &dyn Observer) -> Result<f64, SweepError> {
        let samples = |wanted: &WantedMotion| wanted.pair.horizontal.len() as f64;
        let mut sorted: Vec<&(WantedMotion, Scene)> = self.all[self.motions()].iter().collect();
        sorted.sort_by(|a, b| samples(&a.0).total_cmp(&samples(&b.0)));
        let count = sorted.len().min(MOTIONS);
        let (mut work, mut seconds) = (0.0, 0.0);
        for k in 0..count {
            let (wanted, scene) = sorted[(2 * k + 1) * sorted.len() / (2 * count)];
            // Of its levels each motion of the sample has another.
            let level = (2 * k + 1) * wanted.factors.len() / (2 * count);
            let mut scene = scene.clone();
            if wanted.factors[level] != 1.0 {
                // The motion is scaled to its peak already.
                scene.numbers.remove(Parameter::Pga);
                scene.set(Parameter::Scale, wanted.factors[level] * wanted.pair.factor);
            }
            let (cells, took) = self.sample(&scene, observer)?;
            work += cells as f64 * samples(wanted);
            seconds += took;
        }
        let all = |(wanted, _): &(WantedMotion, Scene)| {
            (self.grid.len() * wanted.factors.len()) as f64 * samples(wanted)
        };
        Ok(seconds / work.max(1.0) * self.all[self.motions()].iter().map(all).sum::<f64>())
    }

    /// Cells of a sample of a sweep, and the seconds that they took: all cells, where they are few.
    fn sample(&self, scene: &Scene, observer: &dyn Observer) -> Result<(usize, f64), SweepError> {
        let cells = self.grid.len();
        if cells > FEW {
            let method = self.sweep_settings().method;
            let backend = &self.opened.backends[0];
            let took = Estimate::of(scene, &method, backend, cells, observer)?;
            return Ok((took.sampled, took.sampled as f64 / took.rate));
        }
        let began = Instant::now();
        sweep_on(&self.opened, scene, &[], &self.sweep_settings(), &Cancels(observer))?;
        Ok((cells, began.elapsed().as_secs_f64()))
    }
}

/// Hears nothing, and ends the work where another would.
struct Cancels<'a>(&'a dyn Observer);

impl Observer for Cancels<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
