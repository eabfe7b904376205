//! A sweep tile by tile: what is done is handed over before the rest goes on.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::backend::{Backend, Precision, Swept};
use super::gpu::GpuError;
use super::plan::Plan;
use crate::integrate::outcome::Outcome;
use crate::scene::Grid;

/// How a sweep is run.
pub struct Run<'a> {
    /// What computes.
    pub backend: &'a Backend,
    /// The scene's plan.
    pub plan: &'a Plan,
    /// Its cells.
    pub grid: &'a Grid,
    /// Number type.
    pub precision: Precision,
    /// Every cell twice.
    pub resolve: bool,
    /// Time that passes at least before what is done is handed over: short runs need not write.
    pub patience: Duration,
    /// Hears of cells as they are done.
    pub progress: &'a (dyn Fn(usize) + Sync),
}

/// Why a sweep stopped.
#[derive(Debug, thiserror::Error)]
pub enum TiledError<E> {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// What was done could not be handed over.
    #[error("{0}")]
    Keep(E),
}

impl Run<'_> {
    /// Cells of a tile: some seconds' work.
    fn tile(&self) -> usize {
        match self.backend {
            Backend::Gpu(_) => 1 << 20,
            Backend::Cpu => 1 << 17,
            Backend::Reference => 1 << 9,
        }
    }

    /// Runs the `missing` cells into `outcomes`, which has one a cell of the grid; `keep` is handed
    /// what is done, in runs of cells, the first of each by number.
    ///
    /// # Errors
    /// The device's, or those of `keep`. What `keep` was handed before stays as it is.
    pub fn fill<E>(
        &self,
        outcomes: &mut [Outcome],
        missing: &[Range<usize>],
        mut keep: impl FnMut(usize, &[Outcome]) -> Result<(), E>,
    ) -> Result<Swept, TiledError<E>> {
        let mut ran = Swept {
            outcomes: Vec::new(),
            elapsed: Duration::ZERO,
            compile: Duration::ZERO,
            device: None,
        };
        let began = Instant::now();
        let mut handed = began;
        for range in missing {
            let mut waiting = range.start;
            for start in range.clone().step_by(self.tile()) {
                let cells = start..(start + self.tile()).min(range.end);
                let swept = self.sweep(cells.clone())?;
                outcomes[cells.clone()].copy_from_slice(&swept.outcomes);
                ran.elapsed += swept.elapsed;
                ran.compile += swept.compile;
                if let Some(time) = swept.device {
                    ran.device = Some(ran.device.unwrap_or_default() + time);
                }
                if handed.elapsed() >= self.patience {
                    keep(waiting, &outcomes[waiting..cells.end]).map_err(TiledError::Keep)?;
                    (waiting, handed) = (cells.end, Instant::now());
                }
            }
            // What is left of a range goes over at its end, if the run has been long at all.
            if waiting < range.end && began.elapsed() >= self.patience {
                keep(waiting, &outcomes[waiting..range.end]).map_err(TiledError::Keep)?;
            }
        }
        Ok(ran)
    }

    fn sweep(&self, cells: Range<usize>) -> Result<Swept, GpuError> {
        let Run { backend, plan, grid, precision, resolve, progress, .. } = *self;
        backend.sweep_range(plan, grid, cells, precision, resolve, progress)
    }
}
