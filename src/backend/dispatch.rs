//! What a sweep runs on.

use std::ops::Range;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::backend_error::BackendError;
use super::cpu;
use super::description::AdapterDescription;
#[cfg(feature = "gpu")]
use super::gpu::{opened::Gpu, run::Sweeper};
use super::snapshots::{PassedOn, resolve};
use crate::cells::plan::{Part, Plan};
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::scene::Grid;
use crate::stepping::outcome::Outcome;
use crate::stepping::reference;
use crate::work::progress::Progress;
use crate::work::threads::install;

/// A backend ready to run.
pub enum Backend {
    /// The shader on a device.
    #[cfg(feature = "gpu")]
    Gpu(Box<Gpu>),
    /// The shader's twin on all cores.
    Cpu,
    /// The reference on all cores.
    Reference,
}

/// Cells that have run, with what they took.
pub struct BackendOutcomes {
    /// Their columns, in the order of the cells.
    pub block: Block,
    /// From the first cell prepared to the last outcome in memory.
    pub elapsed: Duration,
    /// Compilation of the shader.
    pub compile: Duration,
    /// Time in the shader by the device's own clock, where it has one.
    pub device: Option<Duration>,
}

impl Backend {
    /// The number type of the columns of a sweep: the reference computes in f64 whatever a sweep would.
    pub fn columns(&self, precision: Precision) -> Precision {
        match self {
            Backend::Reference => Precision::F64,
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => precision,
            Backend::Cpu => precision,
        }
    }

    /// Most cells of a batch.
    pub fn batch(&self) -> usize {
        match self {
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => 1 << 20,
            Backend::Cpu => 1 << 17,
            Backend::Reference => 1 << 9,
        }
    }

    /// True where the cells of a running batch are given as they are done, see [`Progress::snapshot`]: a batch
    /// may take long.
    pub fn gives_snapshots(&self) -> bool {
        matches!(self, Backend::Cpu)
    }

    /// One word: gpu, cpu or reference.
    pub fn name(&self) -> &'static str {
        match self {
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => "gpu",
            Backend::Cpu => "cpu",
            Backend::Reference => "reference",
        }
    }

    /// The adapter, for a GPU.
    pub fn adapter(&self) -> Option<&AdapterDescription> {
        match self {
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Some(&gpu.description),
            Backend::Cpu | Backend::Reference => None,
        }
    }

    /// Runs all cells of a grid; `progress` is called with the number of cells done since its last call.
    ///
    /// # Errors
    /// Any [`BackendError`] of a GPU; the others do not fail.
    pub fn sweep(
        &self,
        plan: &Plan,
        grid: &Grid,
        precision: Precision,
        progress: &dyn Progress,
    ) -> Result<BackendOutcomes, BackendError> {
        self.sweep_range(plan, grid, 0..grid.len(), precision, false, progress)
    }

    /// Runs some of a grid's cells, numbered one after the other, each once, or twice to `resolve` it.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    pub fn sweep_range(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: Range<usize>,
        precision: Precision,
        resolve: bool,
        progress: &dyn Progress,
    ) -> Result<BackendOutcomes, BackendError> {
        let cells: Vec<usize> = cells.collect();
        self.sweep_list(plan, grid, &cells, (precision, resolve), progress)
    }

    /// Runs a list of a grid's cells, by their numbers and in any order, each once, or twice to `resolve` it. The
    /// outcomes are in the list's order. A cell has the outcome that it has in a sweep of the whole grid: on the CPU
    /// to the last bit.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    pub fn sweep_list(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        (precision, resolve): (Precision, bool),
        progress: &dyn Progress,
    ) -> Result<BackendOutcomes, BackendError> {
        let sweep = if resolve { Backend::sweep_resolved } else { Backend::sweep_cells };
        sweep(self, plan, grid, cells, precision, progress)
    }

    /// Runs a list of a grid's cells once each.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    fn sweep_cells(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        precision: Precision,
        progress: &dyn Progress,
    ) -> Result<BackendOutcomes, BackendError> {
        let began = Instant::now();
        let mut times = Times::default();
        let parts = plan.at(precision).parts(grid, cells);
        let mut ran = Vec::with_capacity(parts.len());
        for part in &parts {
            let of_batch = |block| part.scatter_into(cells.len(), part.mark_locked(block));
            let progress = PassedOn { progress, change: Some(&of_batch) };
            ran.push(part.mark_locked(self.part(part, grid, precision, &progress, &mut times)?));
        }
        if progress.cancelled() {
            return Err(BackendError::Cancelled);
        }
        let block = in_order(cells.len(), self.columns(precision), &parts, ran);
        let Times { compile, device } = times;
        Ok(BackendOutcomes { block, elapsed: began.elapsed() - compile, compile, device })
    }

    /// Runs a list of a grid's cells twice, the second time with steps half as long and, where the backend has it,
    /// in f64, and calls those unresolved whose class the step or the rounding decides; the rest is
    /// of the second run. `progress` hears of every cell twice.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    pub fn sweep_resolved(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: &[usize],
        precision: Precision,
        progress: &dyn Progress,
    ) -> Result<BackendOutcomes, BackendError> {
        // Of the first run nobody is to have outcomes.
        let first = PassedOn { progress, change: None };
        let coarse = self.sweep_cells(plan, grid, cells, precision, &first)?;
        let finer = self.finest(precision);
        let resolved = |mut block: Block| {
            resolve(&mut block, &coarse.block);
            block
        };
        let second = PassedOn { progress, change: Some(&resolved) };
        let mut fine = self.sweep_cells(&plan.halved(), grid, cells, finer, &second)?;
        resolve(&mut fine.block, &coarse.block);
        fine.elapsed += coarse.elapsed;
        fine.compile += coarse.compile;
        fine.device = fine.device.zip(coarse.device).map(|(fine, coarse)| fine + coarse);
        Ok(fine)
    }

    /// f64 where the backend has it, else the number type given.
    pub fn finest(
        &self,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "of a GPU"))]
        precision: Precision,
    ) -> Precision {
        match self {
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) if !gpu.description.f64 => precision,
            _ => Precision::F64,
        }
    }

    /// Runs the cells of a part, in its order.
    fn part(
        &self,
        part: &Part,
        grid: &Grid,
        precision: Precision,
        progress: &dyn Progress,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "of a GPU"))]
        times: &mut Times,
    ) -> Result<Block, BackendError> {
        let (plan, cells) = (&part.plan, part.cells.as_slice());
        let columns = |outcomes: Vec<Outcome>| {
            let precision = self.columns(precision);
            if progress.cancelled() {
                // Some cells have not run.
                return Ok(Block::of_outcomes(&outcomes, precision));
            }
            let mut block = Block::pending(outcomes.len(), precision);
            install(|| block.fill(0, outcomes.len(), |cells, some| some.extend(&outcomes[cells])));
            Ok(block)
        };
        match (self, precision) {
            (Backend::Reference, _) => columns(by_reference(plan, grid, cells, progress)),
            (Backend::Cpu, Precision::F32) => {
                columns(cpu::sweep::<f32>(plan, grid, cells, progress))
            }
            (Backend::Cpu, Precision::F64) => {
                columns(cpu::sweep::<f64>(plan, grid, cells, progress))
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), _) => {
                let compiling = Instant::now();
                let sweeper = Sweeper::new(gpu, precision, plan.variant())?;
                times.compile += compiling.elapsed();
                let (block, time) = match precision {
                    Precision::F32 => {
                        let ran = sweeper.sweep::<f32>(plan, grid, cells, progress)?;
                        (ran.block, ran.device)
                    }
                    Precision::F64 => {
                        let ran = sweeper.sweep::<f64>(plan, grid, cells, progress)?;
                        (ran.block, ran.device)
                    }
                };
                if let Some(time) = time {
                    times.device = Some(times.device.unwrap_or_default() + time);
                }
                Ok(block)
            }
        }
    }
}

/// What the parts of a sweep took of a GPU.
#[derive(Default)]
struct Times {
    /// Compilation of shaders.
    compile: Duration,
    /// Time in them by the device's clock, where it has one.
    device: Option<Duration>,
}

/// The cells of the parts that a list of so many cells was run in, in the list's order.
fn in_order(count: usize, precision: Precision, parts: &[Part], mut ran: Vec<Block>) -> Block {
    if ran.len() == 1 {
        // A part alone holds every cell, in order.
        return ran.remove(0);
    }
    let mut block = Block::pending(count, precision);
    for (part, swept) in parts.iter().zip(&ran) {
        block.scatter(&part.places, swept);
    }
    block
}

fn by_reference(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &dyn Progress,
) -> Vec<Outcome> {
    let settings = reference::Settings::default();
    let run = |&index: &usize| {
        let case = plan.locked(&grid.case(index));
        let outcome =
            reference::run_while(&plan.scene, &case, &settings, &|| !progress.cancelled());
        progress.advance(1);
        // That of a sweep which is cancelled is not used.
        outcome.unwrap_or(Outcome::PENDING)
    };
    install(|| cells.par_iter().map(run).collect())
}
