//! What a sweep runs on.

use std::ops::Range;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::cpu;
use super::gpu::GpuError;
use super::gpu::adapter::Description;
use super::gpu::opened::Gpu;
use super::gpu::run::Sweeper;
use super::plan::{Part, Plan};
use crate::model::precision::Precision;
use crate::scene::Grid;
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::stepping::reference;

/// A backend ready to run.
pub enum Backend {
    /// The shader on a device.
    Gpu(Box<Gpu>),
    /// The shader's twin on all cores.
    Cpu,
    /// The reference on all cores.
    Reference,
}

/// Outcomes with what they took.
pub struct Swept {
    /// One a cell, in the grid's order.
    pub outcomes: Vec<Outcome>,
    /// From the first cell prepared to the last outcome in memory.
    pub elapsed: Duration,
    /// Compilation of the shader.
    pub compile: Duration,
    /// Time in the shader by the device's own clock, where it has one.
    pub device: Option<Duration>,
}

impl Backend {
    /// Most cells of a tile.
    pub fn tile(&self) -> usize {
        match self {
            Backend::Gpu(_) => 1 << 20,
            Backend::Cpu => 1 << 17,
            Backend::Reference => 1 << 9,
        }
    }

    /// One word: gpu, cpu or reference.
    pub fn name(&self) -> &'static str {
        match self {
            Backend::Gpu(_) => "gpu",
            Backend::Cpu => "cpu",
            Backend::Reference => "reference",
        }
    }

    /// The adapter, for a GPU.
    pub fn adapter(&self) -> Option<&Description> {
        match self {
            Backend::Gpu(gpu) => Some(&gpu.description),
            Backend::Cpu | Backend::Reference => None,
        }
    }

    /// Runs all cells of a grid; `progress` is called with the number of cells done since its last call.
    ///
    /// # Errors
    /// Any [`GpuError`] of a GPU; the others do not fail.
    pub fn sweep(
        &self,
        plan: &Plan,
        grid: &Grid,
        precision: Precision,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Swept, GpuError> {
        self.sweep_cells(plan, grid, 0..grid.len(), precision, progress)
    }

    /// Runs some of a grid's cells, each once, or twice to `resolve` it.
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
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Swept, GpuError> {
        let sweep = if resolve { Backend::sweep_resolved } else { Backend::sweep_cells };
        sweep(self, plan, grid, cells, precision, progress)
    }

    /// Runs some of a grid's cells, numbered one after the other.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    fn sweep_cells(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: Range<usize>,
        precision: Precision,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Swept, GpuError> {
        let began = Instant::now();
        let mut compile = Duration::ZERO;
        let mut device = None;
        let parts = plan.at(precision).parts(grid, cells.clone());
        let mut ran = Vec::with_capacity(parts.len());
        for part in &parts {
            let mut outcomes =
                self.part(part, grid, precision, progress, &mut compile, &mut device)?;
            if part.vertical_locked {
                let ran =
                    |outcome: &&mut Outcome| matches!(outcome.status, Status::Ok | Status::Proved);
                for outcome in outcomes.iter_mut().filter(ran) {
                    outcome.status = Status::VerticalLocked;
                }
            }
            ran.push(outcomes);
        }
        let outcomes = in_order(&cells, &parts, ran);
        Ok(Swept { outcomes, elapsed: began.elapsed() - compile, compile, device })
    }

    /// Runs some of a grid's cells twice, the second time with steps half as long and, where the backend has it,
    /// in f64, and calls those unresolved whose class the step or the rounding decides; the rest is
    /// of the second run. `progress` hears of every cell twice.
    ///
    /// # Errors
    /// Those of [`Backend::sweep`].
    pub fn sweep_resolved(
        &self,
        plan: &Plan,
        grid: &Grid,
        cells: Range<usize>,
        precision: Precision,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Swept, GpuError> {
        let coarse = self.sweep_cells(plan, grid, cells.clone(), precision, progress)?;
        let finer = match self {
            Backend::Gpu(gpu) if !gpu.description.f64 => precision,
            _ => Precision::F64,
        };
        let mut fine = self.sweep_cells(&plan.halved(), grid, cells, finer, progress)?;
        for (cell, other) in fine.outcomes.iter_mut().zip(&coarse.outcomes) {
            if cell.class != other.class && cell.class != Class::Unresolved {
                (cell.class, cell.status) = (Class::Unresolved, Status::Undecided);
            }
        }
        fine.elapsed += coarse.elapsed;
        fine.compile += coarse.compile;
        fine.device = fine.device.zip(coarse.device).map(|(fine, coarse)| fine + coarse);
        Ok(fine)
    }

    /// Runs the cells of a part, in its order.
    fn part(
        &self,
        part: &Part,
        grid: &Grid,
        precision: Precision,
        progress: &(dyn Fn(usize) + Sync),
        compile: &mut Duration,
        device: &mut Option<Duration>,
    ) -> Result<Vec<Outcome>, GpuError> {
        let (plan, cells) = (&part.plan, part.cells.as_slice());
        let gpu = match (self, precision) {
            (Backend::Reference, _) => return Ok(by_reference(plan, grid, cells, progress)),
            (Backend::Cpu, Precision::F32) => {
                return Ok(cpu::sweep::<f32>(plan, grid, cells, progress));
            }
            (Backend::Cpu, Precision::F64) => {
                return Ok(cpu::sweep::<f64>(plan, grid, cells, progress));
            }
            (Backend::Gpu(gpu), _) => gpu,
        };
        let compiling = Instant::now();
        let sweeper = Sweeper::new(gpu, precision, plan.variant())?;
        *compile += compiling.elapsed();
        let (outcomes, time) = match precision {
            Precision::F32 => {
                let ran = sweeper.sweep::<f32>(plan, grid, cells, progress)?;
                (ran.outcomes, ran.device)
            }
            Precision::F64 => {
                let ran = sweeper.sweep::<f64>(plan, grid, cells, progress)?;
                (ran.outcomes, ran.device)
            }
        };
        if let Some(time) = time {
            *device = Some(device.unwrap_or_default() + time);
        }
        Ok(outcomes)
    }
}

/// The outcomes of the parts that some cells were run in, in the grid's order.
fn in_order(cells: &Range<usize>, parts: &[Part], mut ran: Vec<Vec<Outcome>>) -> Vec<Outcome> {
    if ran.len() == 1 {
        // A part alone holds every cell, in order.
        return ran.remove(0);
    }
    let mut outcomes: Vec<Option<Outcome>> = vec![None; cells.len()];
    for (part, swept) in parts.iter().zip(ran) {
        for (&index, outcome) in part.cells.iter().zip(swept) {
            outcomes[index - cells.start] = Some(outcome);
        }
    }
    // The parts hold every cell once.
    outcomes.into_iter().flatten().collect()
}

fn by_reference(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
) -> Vec<Outcome> {
    let settings = reference::Settings::default();
    let run = |&index: &usize| {
        let outcome = reference::run(&plan.scene, &plan.locked(&grid.case(index)), &settings);
        progress(1);
        outcome
    };
    cells.par_iter().map(run).collect()
}
