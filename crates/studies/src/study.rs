//! A study of a suite: what is asked of its motions, the sweeps that answer it, and the tables of what they tell.

use std::io::{self, Write};

use crate::sheet::TableError;
use crate::suites::Suite;
use crate::suites::swept::{SuiteJob, SuiteSweep};
use crate::table::Table;
use topple::backend::backend_error::BackendError;
use topple::scene::{Scene, SceneError};
use topple::sweep::error::SweepError;
use topple::work::observer::Observer;

/// What is asked of the motions of a suite.
pub trait StudyRequest: Sync {
    /// What answers it.
    type Study: Study;

    /// Checks what can be checked before a suite is read.
    ///
    /// # Errors
    /// The first key at fault, or the device, with what to do.
    fn check(&self) -> Result<(), StudyError>;

    /// Makes it ready to run under a suite.
    ///
    /// # Errors
    /// Those of [`check`](StudyRequest::check), numbers that make no sense, a backend that cannot be had.
    fn open(&self, suite: &Suite) -> Result<StudyJob<Self::Study>, StudyError>;

    /// The tables that a study of it may have.
    fn tables(&self) -> Vec<StudyTable<Self::Study>>;

    /// The files for other programs that it may have.
    fn exports(&self) -> Vec<StudyExport<Self::Study>> {
        Vec::new()
    }

    /// True where a study has something for one of these files.
    fn has(&self, _study: &Self::Study, _file: &str) -> bool {
        true
    }
}

/// What the sweeps of a suite tell.
pub trait Study: Send + Sized {
    /// What is computed for them, and how.
    type Settings: Send;

    /// Reduces the sweeps; none where `observer` ends it.
    fn of(sweep: SuiteSweep, settings: Self::Settings, observer: &dyn Observer) -> Option<Self>;

    /// The sweeps that it was made of.
    fn sweep(&mut self) -> &mut SuiteSweep;
}

/// A study that is ready to run.
pub struct StudyJob<S: Study> {
    /// The sweeps.
    pub sweep: SuiteJob,
    /// What is computed for them, and how.
    pub settings: S::Settings,
    /// How often each motion is swept.
    pub times: usize,
    /// The scenes under their first motions.
    pub scenes: Vec<Scene>,
}

impl<S: Study> StudyJob<S> {
    /// Runs the sweeps and reduces them.
    ///
    /// # Errors
    /// Those of [`SuiteJob::run`], and that the observer ended it.
    pub fn run(self, observer: &dyn Observer) -> Result<S, SweepError> {
        let swept = self.sweep.run(observer)?;
        Ok(S::of(swept, self.settings, observer).ok_or(BackendError::Cancelled)?)
    }
}

/// A table of a study: the name of its file, and what makes it.
pub type StudyTable<S> = (&'static str, for<'a> fn(&'a S) -> Table<'a>);
/// A file of a study for another program: its name, and what writes it.
pub type StudyExport<S> = (&'static str, fn(&S, &mut dyn Write) -> io::Result<()>);

/// Why there is no study.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A device makes no scene.
    #[error(transparent)]
    Devices(#[from] TableError),
    /// An invalid setting, or a sweep that failed.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}

impl From<SceneError> for StudyError {
    fn from(error: SceneError) -> StudyError {
        SweepError::from(error).into()
    }
}
