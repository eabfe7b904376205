//! The one way to run a sweep.

use std::sync::Arc;

use super::error::SweepError;
use super::job::{Job, SweepResult};
use super::map::MapSweep;
use super::settings::RunSettings;
use crate::backend::request::OpenBackends;
use crate::scene::{Parameter, Scene, SceneError, Values};
use crate::work::observer::Observer;

/// Sweeps a scene over axes, which take the place of its own numbers, and has the reference verify a sample
/// of the cells. `observer` hears of phases and progress and may end it; [`Unwatched`] does neither, and a
/// flag ([`AtomicBool`](std::sync::atomic::AtomicBool)) only ends it.
///
/// With [`RunSettings::saving`] finished cells are saved as the sweep goes on, and an interrupted one resumes.
/// What is saved stays until [`MapSweep::discard_saved`] removes it or [`MapSweep::publish`] makes it the
/// map.zarr; until then only a run that resumes may begin in the same directory. To run a part of a grid use a
/// [`Job`]: this function returns whole maps only.
///
/// # Errors
/// [`SweepError`]: numbers or settings that make no sense, by their keys; a backend that failed; a directory
/// that cannot be written; an observer that ended it.
///
/// [`Unwatched`]: crate::work::observer::Unwatched
pub fn sweep(
    scene: &Scene,
    axes: &[(Parameter, Values)],
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<MapSweep, SweepError> {
    if settings.saving.as_ref().is_some_and(|saving| saving.shard.is_some()) {
        return Err(no_map());
    }
    finish(Job::open(scene, axes, settings)?, settings, observer)
}

/// The same on backends that are open.
///
/// # Errors
/// Those of [`sweep`].
pub fn sweep_on(
    opened: &Arc<OpenBackends>,
    scene: &Scene,
    axes: &[(Parameter, Values)],
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<MapSweep, SweepError> {
    finish(Job::on(opened, scene, axes, settings)?, settings, observer)
}

fn finish(
    job: Job,
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<MapSweep, SweepError> {
    let estimate = job.estimate_if_long(observer)?;
    match job.run(estimate.as_ref(), observer)? {
        SweepResult::Map(mut map) => {
            if settings.verify.cells > 0 && !map.by_reference() {
                let verified = map.verify(&settings.verify, observer);
                map.verification = Some(verified.map_err(|error| map.stopped(error))?);
            }
            Ok(*map)
        }
        SweepResult::Shard(..) => Err(no_map()),
    }
}

fn no_map() -> SweepError {
    let problem = "a shard is no map; run it as a job".into();
    SceneError { key: "tile", problem }.into()
}
