//! A backend that is ready to run, of any kind: it makes outcomes of cells.

use std::borrow::Cow;
use std::time::{Duration, Instant};

use fearless_simd::Level;

use super::backend_error::BackendError;
use super::by_reference::by_reference;
use super::cell_run::{CellRun, Snapshots};
use super::description::AdapterDescription;
#[cfg(feature = "gpu")]
use super::gpu::{opened::Gpu, run::Sweeper};
use super::lanes;
use crate::cells::part::Part;
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::stepping::reference::Settings;
use crate::work::observer::Observer;
use crate::work::parallel;

/// A backend that is ready to run.
pub enum Backend {
    /// The shader on a device.
    #[cfg(feature = "gpu")]
    Gpu(Box<Gpu>),
    /// The Rust twin of the shader, on all cores.
    Cpu,
    /// The reference on all cores.
    Reference,
}

/// The outcomes of cells that have run, and the time that they took.
pub struct BackendOutcomes {
    /// The columns of the outcomes, in the order of the cells.
    pub block: Block,
    /// The time from the preparation of the first cell to the last outcome in memory.
    pub elapsed: Duration,
    /// The time to compile the shader.
    pub compile: Duration,
    /// The time in the shader by the clock of the device, if it has one.
    pub device: Option<Duration>,
}

impl Backend {
    /// The number type of the columns of a sweep: the reference always computes in f64.
    pub fn columns(&self, precision: Precision) -> Precision {
        match self {
            Backend::Reference => Precision::F64,
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => precision,
            Backend::Cpu => precision,
        }
    }

    /// The most cells of a batch.
    pub fn batch(&self) -> usize {
        match self {
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => 1 << 20,
            Backend::Cpu => 1 << 17,
            Backend::Reference => 1 << 9,
        }
    }

    /// True where the cells of a running batch are passed on as they are done, see [`Snapshots`]: a batch may take
    /// long.
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

    /// Runs cells. `observer` is told of each cell that is done, twice where it runs twice. A cell has the same
    /// outcome as in a run of the whole grid: on the CPU to the last bit.
    ///
    /// # Errors
    /// Any [`BackendError`] of a GPU; that it was cancelled.
    pub fn run(
        &self,
        run: &CellRun,
        observer: &dyn Observer,
    ) -> Result<BackendOutcomes, BackendError> {
        match run.resolve {
            true => self.run_twice(run, observer),
            false => self.run_once(run, observer),
        }
    }

    fn run_once(
        &self,
        run: &CellRun,
        observer: &dyn Observer,
    ) -> Result<BackendOutcomes, BackendError> {
        let (began, count) = (Instant::now(), run.cells.len());
        let mut times = Times::default();
        let parts = Part::of(&run.plan.at(run.precision), run.grid, &run.cells);
        let mut ran = Vec::with_capacity(parts.len());
        for part in &parts {
            let take = run.snapshots.map(|to| {
                move |block| (to.take)(part.scatter_into(count, part.mark_locked(block)))
            });
            let snapshots = run.snapshots.zip(take.as_ref());
            let snapshots = snapshots.map(|(to, take)| Snapshots { due: to.due, take });
            let cells = part.cells.as_slice().into();
            let run = CellRun { plan: &part.plan, cells, snapshots, ..*run };
            ran.push(part.mark_locked(self.run_part(&run, observer, &mut times)?));
        }
        if observer.cancelled() {
            return Err(BackendError::Cancelled);
        }
        let block = in_order(count, self.columns(run.precision), &parts, ran);
        let Times { compile, device } = times;
        Ok(BackendOutcomes { block, elapsed: began.elapsed() - compile, compile, device })
    }

    /// Runs cells twice, the second time with half the step and, where the backend has it, in f64. A cell is
    /// unresolved if its class depends on the step or on the rounding; the other values are those of the second run.
    fn run_twice(
        &self,
        run: &CellRun,
        observer: &dyn Observer,
    ) -> Result<BackendOutcomes, BackendError> {
        let cells = || Cow::from(&*run.cells);
        // The outcomes of the first run are not passed on.
        let first = CellRun { cells: cells(), snapshots: None, ..*run };
        let coarse = self.run_once(&first, observer)?;
        let resolved = |mut block: Block| {
            resolve(&mut block, &coarse.block);
            block
        };
        let take = run.snapshots.map(|to| move |block| (to.take)(resolved(block)));
        let snapshots = run.snapshots.zip(take.as_ref());
        let snapshots = snapshots.map(|(to, take)| Snapshots { due: to.due, take });
        let (plan, precision) = (&run.plan.halved(), self.finest(run.precision));
        let finer = CellRun { plan, cells: cells(), precision, snapshots, ..*run };
        let mut fine = self.run_once(&finer, observer)?;
        resolve(&mut fine.block, &coarse.block);
        fine.elapsed += coarse.elapsed;
        fine.compile += coarse.compile;
        fine.device = fine.device.zip(coarse.device).map(|(fine, coarse)| fine + coarse);
        Ok(fine)
    }

    /// f64 where the backend has it, else the given number type.
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

    /// Runs cells that run one model.
    fn run_part(
        &self,
        run: &CellRun,
        observer: &dyn Observer,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "of a GPU"))]
        times: &mut Times,
    ) -> Result<Block, BackendError> {
        Ok(match self {
            Backend::Reference => {
                let outcomes = all_by_reference(run, observer);
                Block::of_outcomes(&outcomes, self.columns(run.precision))
            }
            Backend::Cpu => lanes::sweep(run, observer, Level::new()),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => on_device(gpu, run, observer, times)?,
        })
    }
}

#[cfg(feature = "gpu")]
fn on_device(
    gpu: &Gpu,
    run: &CellRun,
    observer: &dyn Observer,
    times: &mut Times,
) -> Result<Block, BackendError> {
    let compiling = Instant::now();
    let sweeper = Sweeper::new(gpu, run.precision, run.plan.variant())?;
    times.compile += compiling.elapsed();
    let CellRun { plan, grid, cells, .. } = run;
    let (block, time) = match run.precision {
        Precision::F32 => {
            let ran = sweeper.sweep::<f32>(plan, grid, cells, observer)?;
            (ran.block, ran.device)
        }
        Precision::F64 => {
            let ran = sweeper.sweep::<f64>(plan, grid, cells, observer)?;
            (ran.block, ran.device)
        }
    };
    if let Some(time) = time {
        times.device = Some(times.device.unwrap_or_default() + time);
    }
    Ok(block)
}

/// The time that the parts of a sweep took of a GPU.
#[derive(Default)]
struct Times {
    /// The time to compile shaders.
    compile: Duration,
    /// The time in shaders by the clock of the device, if it has one.
    device: Option<Duration>,
}

/// The outcomes of the cells of all parts, in the order of the list of a given number of cells.
fn in_order(count: usize, precision: Precision, parts: &[Part], mut ran: Vec<Block>) -> Block {
    if ran.len() == 1 {
        // A single part holds every cell, in order.
        return ran.remove(0);
    }
    let mut block = Block::pending(count, precision);
    for (part, swept) in parts.iter().zip(&ran) {
        block.scatter(&part.places, swept);
    }
    block
}

fn all_by_reference(run: &CellRun, observer: &dyn Observer) -> Vec<Outcome> {
    let settings = Settings::default();
    let go_on = || !observer.cancelled();
    let cell = |number: usize| {
        let case = run.grid.case(run.cells[number]);
        let outcome = by_reference(run.plan, &case, &settings, &go_on);
        observer.advance(1);
        // The result of a sweep that was cancelled is not used.
        outcome.unwrap_or(Outcome::PENDING)
    };
    parallel::each(run.cells.len(), 1, cell)
}

/// Marks cells as unresolved that another run classifies otherwise; cells that have not run stay pending.
fn resolve(block: &mut Block, other: &Block) {
    block.recode(|cell, class, status| {
        if class == other.class(cell) || class == Class::Unresolved {
            (class, status)
        } else {
            (Class::Unresolved, Status::Undecided)
        }
    });
}
