//! The one way to run a suite's sweep.

use std::time::Instant;

use super::runner::Runner;
use super::swept::{SuiteJob, SuiteSweep};
use super::wanted::WantedMotion;
use crate::scene::Scene;
use crate::sweep::error::SweepError;
use crate::sweep::observer::{Observer, Phase};

impl SuiteJob {
    /// Runs it; none where a part was asked for, whose motions are saved.
    ///
    /// # Errors
    /// A backend that failed, a directory that cannot be written, an observer that ended it.
    pub fn run(self, observer: &dyn Observer) -> Result<Option<SuiteSweep>, SweepError> {
        let began = Instant::now();
        let runs = if self.settings.run.method.resolve { 2 } else { 1 };
        let part = self.settings.part;
        let wanted = part.map_or(0..self.all.len(), |part| part.cells(self.all.len()));
        let cells = |(wanted, _): &(WantedMotion, Scene)| wanted.factors.len() * self.grid.len();
        let total: usize = self.all[wanted.clone()].iter().map(cells).sum();
        observer.begins(Phase::Sweeping, runs * total);
        let runner = Runner::new(&self, wanted, observer);
        let swept = runner.run()?;
        let seconds = began.elapsed().as_secs_f64();
        if part.is_some() {
            return Ok(None);
        }
        let verifications = swept.verify(self.settings.run.verify.within, observer)?;
        let (motions, resumed) = (swept.motions, swept.resumed);
        let SuiteJob { scene, grid, .. } = self;
        Ok(Some(SuiteSweep { scene, grid, motions, resumed, seconds, verifications }))
    }
}
