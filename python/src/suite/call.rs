//! A call that sweeps a scene under a suite: what it is given, how its motions are run, and what it gives back.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use topple::work::threads::Threads;
use topple::{Saving, SceneError, StoreError, SweepError};
use topple_studies::fragility::RUNS;
use topple_studies::suites::read::Reading;
use topple_studies::suites::saved;
use topple_studies::{Study, StudyError, StudyRequest, Suite, SuiteRequest};

use super::described::columns;
use crate::errors::{of_keyword, of_scene, of_suite, of_sweep};
use crate::keywords::{Request, baseline, given, taken, warn_of_doubts};
use crate::watch::{self, Watch};

/// The keywords of each such call that are not those of a scene.
const SHARED: &str = "suite strict baseline both_directions limit_u limit_v resample seed";

/// Tables by name, each as its [`columns`], and JSON; of a part of the motions there are none.
pub type Tables<'py> = (Option<Bound<'py, PyDict>>, Option<String>);

/// What keywords ask for, beside the request of the suite.
pub struct Call<'a, 'py> {
    pub py: Python<'py>,
    pub keywords: &'a Bound<'py, PyDict>,
    pub suite: Suite,
    progress: Option<&'a Bound<'py, PyAny>>,
    threads: Threads,
    resume: bool,
    shard: bool,
}

impl<'a, 'py> Call<'a, 'py> {
    /// The call of keywords, of which `own` are those of its kind alone, and the request of its suite.
    pub fn of(
        py: Python<'py>,
        keywords: &'a Bound<'py, PyDict>,
        progress: Option<&'a Bound<'py, PyAny>>,
        own: &str,
    ) -> PyResult<(Call<'a, 'py>, SuiteRequest)> {
        let path = keywords.get_item("suite")?.ok_or_else(|| {
            of_keyword("suite", "missing; give a folder, a zip or a list of records")
        })?;
        let path: PathBuf = taken("suite", &path, "a path")?;
        let strict = given(keywords, "strict", "True or False")?.unwrap_or(false);
        let others: Vec<&str> = SHARED.split(' ').chain(own.split(' ')).collect();
        let Request { scene, settings, threads, .. } = Request::of(keywords, &others)?;
        settings.method.check_step(scene.force).map_err(of_scene)?;
        if settings.method.repair {
            return Err(of_keyword(
                "repair",
                "sweeps under a suite are not repaired; leave it out",
            ));
        }
        if !settings.method.columns.is_all() {
            return Err(of_keyword("columns", "they are those of maps; leave it out"));
        }
        let mut request = SuiteRequest::new(scene);
        request.both_directions =
            given(keywords, "both_directions", "True or False")?.unwrap_or(false);
        let saving = settings.saving.as_ref();
        if saving.is_some_and(|saving| saving.directory.as_os_str().is_empty()) {
            return Err(of_keyword("out", "missing; resume and tile need a directory"));
        }
        let resume = saving.is_some_and(|saving| saving.resume);
        if let Some(Saving { directory, shard: None, .. }) = saving
            && saved::is_begun(directory)
            && !resume
        {
            return Err(of_sweep(SweepError::Folder(StoreError::Unfinished(directory.clone()))));
        }
        request.settings.saving = saving.map(|saving| saved::folder(&saving.directory));
        request.settings.shard = saving.and_then(|saving| saving.shard);
        request.settings.run = settings;
        let shard = request.settings.shard.is_some();
        let reading =
            Reading { strict, baseline: baseline(given(keywords, "baseline", "none or line")?)? };
        let suite = watch::run_unheard(py, move || Suite::read_as(&path, reading))?;
        let suite = suite.map_err(of_suite)?;
        let doubts = suite.motions().flat_map(|(entry, motion)| {
            motion.pair.doubts.iter().map(|doubt| format!("{}: {doubt}", entry.id))
        });
        let doubts: Vec<String> = suite.doubts.iter().cloned().chain(doubts).collect();
        warn_of_doubts(&doubts)?;
        Ok((Call { py, keywords, suite, progress, threads, resume, shard }, request))
    }

    /// Runs the sweeps of a request; a shard gives nothing. With `resume` a directory that holds motions of another run is refused.
    pub fn run<R: StudyRequest>(&self, request: &R) -> PyResult<Option<R::Study>> {
        let Call { suite, resume, shard, .. } = self;
        request.check().map_err(of_study)?;
        let run = |watch: &Watch| {
            let job = request.open(suite)?;
            if *resume && job.sweep.finds_others()? {
                let problem = "the directory holds motions of another run; give the keywords of that run, or another directory";
                let error = SceneError { key: "resume", problem: problem.into() };
                return Err(SweepError::from(error).into());
            }
            match shard {
                true => Ok(job.sweep.run(watch).map(|_| None)?),
                false => Ok(job.run(watch).map(Some)?),
            }
        };
        watch::run(self.py, self.progress, &self.threads, run)?.map_err(of_study)
    }

    /// The result of the call: tables by their names, and what is told of them. Frees the motions that were saved.
    pub fn tables<R: StudyRequest>(
        &self,
        request: &R,
        mut study: R::Study,
        about: &Value,
    ) -> PyResult<Tables<'py>> {
        let all = PyDict::new(self.py);
        for (file, table) in request.tables() {
            if file != RUNS && request.has(&study, file) {
                let table = columns(self.py, table(&study))?;
                all.set_item(file.trim_end_matches(".csv"), table)?;
            }
        }
        study.sweep().discard_saved()?;
        Ok((Some(all), Some(about.to_string())))
    }
}

/// What is wrong with devices, or with a sweep.
fn of_study(error: StudyError) -> PyErr {
    match error {
        StudyError::Devices(error) => of_keyword("devices", error),
        StudyError::Sweep(error) => of_sweep(error),
    }
}
