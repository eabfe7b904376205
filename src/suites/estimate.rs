//! What a suite's sweep will take, from a sample of its motions.

use super::swept::SuiteJob;
use super::wanted::WantedMotion;
use crate::scene::{Parameter, Scene};
use crate::sweep::error::SweepError;
use crate::sweep::estimate::Estimate;
use crate::sweep::progress::Progress;

/// Motions of the sample.
const MOTIONS: usize = 5;

impl SuiteJob {
    /// Seconds that all its cells will take. Long motions take longer: a cell's time is told by a motion's samples.
    ///
    /// # Errors
    /// Those of the backend, and that it was cancelled.
    pub fn estimate(&self, progress: &dyn Progress) -> Result<f64, SweepError> {
        let samples = |wanted: &WantedMotion| wanted.pair.horizontal.len() as f64;
        let mut sorted: Vec<&(WantedMotion, Scene)> = self.all[self.motions()].iter().collect();
        sorted.sort_by(|a, b| samples(&a.0).total_cmp(&samples(&b.0)));
        let count = sorted.len().min(MOTIONS);
        let (mut work, mut seconds) = (0.0, 0.0);
        for k in 0..count {
            let (wanted, scene) = sorted[(2 * k + 1) * sorted.len() / (2 * count)];
            let mut scene = scene.clone();
            // A level in the middle of its levels.
            if let Some(factor) = wanted.factors.get(wanted.factors.len() / 2)
                && *factor != 1.0
            {
                scene.set(Parameter::Scale, factor * wanted.pair.factor);
            }
            let (method, backend) = (&self.settings.run.method, &self.opened.backends[0]);
            let took = Estimate::of(&scene, method, backend, self.grid.len(), progress)?;
            work += took.sampled as f64 * samples(wanted);
            seconds += took.sampled as f64 / took.rate;
        }
        let all = |(wanted, _): &(WantedMotion, Scene)| {
            (self.grid.len() * wanted.factors.len()) as f64 * samples(wanted)
        };
        Ok(seconds / work.max(1.0) * self.all[self.motions()].iter().map(all).sum::<f64>())
    }
}
