//! The one way to run a suite's sweep.

use std::time::Instant;

use super::runner::Runner;
use super::saved::{self, SavedMotions};
use super::swept::{SuiteJob, SuiteSweep};
use super::verified::Verified;
use topple::results::lock::Holds;
use topple::sweep::error::SweepError;
use topple::work::observer::{Observer, Phase};

impl SuiteJob {
    /// Runs it; the sweep has the motions of the shard, where one was requested, and these are saved.
    ///
    /// # Errors
    /// A backend that failed, a directory that is in use or cannot be written, an observer that ended it.
    pub fn run(self, observer: &dyn Observer) -> Result<SuiteSweep, SweepError> {
        // Shards may run at the same time: each motion is a file of its own.
        let holds = if self.settings.shard.is_some() { Holds::Together } else { Holds::Alone };
        let folder = self.settings.saving.as_ref();
        let saved = folder.map(|folder| SavedMotions::lock(folder, holds)).transpose();
        let saved = saved.map_err(SweepError::Folder)?;
        let began = Instant::now();
        let runs = if self.settings.run.method.resolve { 2 } else { 1 };
        observer.begins(Phase::Sweeping, runs * self.cells());
        let swept = Runner::new(&self, self.motions(), observer).run()?;
        let seconds = began.elapsed().as_secs_f64() - swept.verifying;
        let mut verified = Verified::default();
        swept.motions.iter().for_each(|motion| verified.add(&motion.verified));
        let (motions, resumed) = (swept.motions, swept.resumed);
        let SuiteJob { scene, grid, opened, .. } = self;
        let backend = opened.backends[0].name();
        let adapter = opened.backends[0].adapter().cloned();
        Ok(SuiteSweep { scene, grid, motions, resumed, backend, adapter, seconds, verified, saved })
    }

    /// True where the folder that it saves to holds motions, and none of its own.
    ///
    /// # Errors
    /// Those of the writer of a motion's name, and something in the folder that no run wrote.
    pub fn finds_others(&self) -> Result<bool, SweepError> {
        let folder = self.settings.saving.as_ref();
        folder
            .map_or(Ok(()), |folder| saved::refuse_foreign(folder))
            .map_err(SweepError::Folder)?;
        let there = folder.map(|folder| saved::names(folder));
        let Some(there) = there.filter(|there| !there.is_empty()) else { return Ok(false) };
        let backend = &self.opened.backends[0];
        for (wanted, scene) in &self.all {
            if there.contains(&saved::tag(wanted, scene, backend, &self.settings)?) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
