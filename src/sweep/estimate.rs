//! What a sweep will take, from a sample of it.

use std::time::Duration;

use super::error::SweepError;
use super::settings::Method;
use crate::backend::cell_run::CellRun;
use crate::backend::ready::Backend;
use crate::results::about::Source;
use crate::results::size::FileSizes;
use crate::scene::{Grid, Scene};
use crate::work::observer::Observer;

/// Least and most points of each axis of a sample over two axes; one over more or fewer axes has as many cells in all.
const SIDE: [f64; 2] = [16.0, 96.0];
/// Cells of a run for each one of its sample, between these ends.
const SHARE: f64 = 100.0;

/// What a sweep takes.
#[derive(Debug, Clone, Copy)]
pub struct Estimate {
    /// Cells of the sample.
    pub sampled: usize,
    /// Cells a second of one worker.
    pub rate: f64,
    /// Time of compiling the shader, which the run need not spend again.
    pub compile: Duration,
    /// Bytes of the map's files.
    pub files: FileSizes,
}

impl Estimate {
    /// Of `cells` cells of a scene's grid, from a coarser grid of the same scene.
    ///
    /// # Errors
    /// Those of the backend, and [`SweepError::Backend`] where it is cancelled.
    pub fn of(
        scene: &Scene,
        method: &Method,
        backend: &Backend,
        cells: usize,
        observer: &dyn Observer,
    ) -> Result<Estimate, SweepError> {
        let mut sample = scene.clone();
        let side = (cells as f64 / SHARE).sqrt().clamp(SIDE[0], SIDE[1]);
        let swept = sample.swept();
        // As many cells as a square has, by as many axes as there are.
        let most = side.powf(2.0 / swept.len().max(1) as f64).max(2.0) as usize;
        for parameter in swept {
            if let Some(values) = sample.numbers.get(parameter) {
                let thinned = values.thinned(most);
                sample.set(parameter, thinned);
            }
        }
        let (plan, grid) = (method.plan(&sample)?, Grid::of(&sample));
        let Method { precision, resolve, .. } = *method;
        let all = CellRun::all(&plan, &grid, precision).resolving(resolve);
        let swept = backend.run(&all, observer)?;
        let columns = method.columns;
        let source = Source { scene, precision: backend.columns(precision), columns };
        let files = FileSizes::of(&grid, &swept.block, source, Grid::of(scene).len())?;
        let rate = grid.len() as f64 / swept.times.elapsed.as_secs_f64().max(1.0e-9);
        Ok(Estimate { sampled: grid.len(), rate, compile: swept.times.compile, files })
    }
}
