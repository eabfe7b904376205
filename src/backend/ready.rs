//! A backend that is ready to run, of any kind: it makes outcomes of cells.

use std::time::{Duration, Instant};

use fearless_simd::Level;

use super::backend_error::BackendError;
use super::by_reference::by_reference;
use super::cell_run::CellRun;
use super::description::AdapterDescription;
#[cfg(feature = "gpu")]
use super::gpu::{opened::Gpu, run::Sweeper};
use super::lanes;
use super::sink::{Sink, collected};
use crate::cells::part::Part;
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::results::collector::OutcomeCollector;
use crate::results::column_set::ColumnSet;
use crate::results::columns::Column;
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

/// The time that cells took.
#[derive(Debug, Clone, Copy, Default)]
pub struct RunTimes {
    /// The time from the preparation of the first cell to the last outcome in memory, without that of compiling.
    pub elapsed: Duration,
    /// The time to compile the shader.
    pub compile: Duration,
    /// The time in the shader by the clock of the device, if it has one.
    pub device: Option<Duration>,
}

/// The outcomes of cells that have run, and the time that they took.
pub struct BackendOutcomes {
    /// The columns of the outcomes, in the order of the cells.
    pub block: Block,
    /// The time that they took.
    pub times: RunTimes,
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
            Backend::Gpu(_) => 1 << 24,
            Backend::Cpu => 1 << 17,
            Backend::Reference => 1 << 9,
        }
    }

    /// True where each cell is handed over soon after its end. Others hand over many at once: their batches are to be
    /// so small that finished cells are saved in time.
    pub fn hands_over_cells(&self) -> bool {
        matches!(self, Backend::Cpu | Backend::Reference)
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

    /// Runs cells, and collects their outcomes; see [`Backend::run_into`].
    ///
    /// # Errors
    /// Those of [`Backend::run_into`].
    pub fn run(
        &self,
        run: &CellRun,
        observer: &dyn Observer,
    ) -> Result<BackendOutcomes, BackendError> {
        let precision = if run.resolve { self.finest(run.precision) } else { run.precision };
        let into = |sink: Sink| self.run_into(run, sink, observer);
        let (block, times) = collected(run.cells.len(), self.columns(precision), into);
        Ok(BackendOutcomes { block, times: times? })
    }

    /// Runs cells and hands over their outcomes as they end. `observer` is told of each cell that is done, twice where
    /// it runs twice. A cell has the same outcome as in a run of the whole grid: on the CPU to the last bit.
    ///
    /// # Errors
    /// Any [`BackendError`] of a GPU; that it was cancelled. What was handed over before is right.
    pub fn run_into(
        &self,
        run: &CellRun,
        sink: Sink,
        observer: &dyn Observer,
    ) -> Result<RunTimes, BackendError> {
        match run.resolve {
            true => self.run_twice(run, sink, observer),
            false => self.run_once(run, sink, observer),
        }
    }

    fn run_once(
        &self,
        run: &CellRun,
        sink: Sink,
        observer: &dyn Observer,
    ) -> Result<RunTimes, BackendError> {
        let began = Instant::now();
        let mut times = RunTimes::default();
        for part in Part::of(&run.plan.at(run.precision), run.grid, run.cells) {
            let cells = part.cells(run.cells);
            let run = CellRun { plan: &part.plan, cells, ..*run };
            self.run_part(&run, sink.of_part(&part), observer, &mut times)?;
        }
        if observer.cancelled() {
            return Err(BackendError::Cancelled);
        }
        Ok(RunTimes { elapsed: began.elapsed() - times.compile, ..times })
    }

    /// Runs cells twice, the second time with half the step and, where the backend has it, in f64. A cell is
    /// unresolved if its class depends on the step or on the rounding; the other values are those of the second run.
    fn run_twice(
        &self,
        run: &CellRun,
        sink: Sink,
        observer: &dyn Observer,
    ) -> Result<RunTimes, BackendError> {
        // Only the classes of the first run are read.
        let classes = ColumnSet::of(&[Column::Outcome, Column::Status]);
        let precision = self.columns(run.precision);
        let collector = OutcomeCollector::in_memory(run.cells.len(), precision, classes);
        let coarse = self.run_once(run, Sink::from(0, &collector), observer)?;
        let block = collector.into_block();
        let (plan, precision) = (&run.plan.halved(), self.finest(run.precision));
        let finer = CellRun { plan, precision, ..*run };
        let fine = self.run_once(&finer, sink.resolving(&block), observer)?;
        Ok(RunTimes {
            elapsed: fine.elapsed + coarse.elapsed,
            compile: fine.compile + coarse.compile,
            device: fine.device.zip(coarse.device).map(|(fine, coarse)| fine + coarse),
        })
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
        sink: Sink,
        observer: &dyn Observer,
        #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "of a GPU"))]
        times: &mut RunTimes,
    ) -> Result<(), BackendError> {
        match self {
            Backend::Reference => all_by_reference(run, sink, observer),
            Backend::Cpu => lanes::sweep_into(run, sink, observer, Level::new()),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => on_device(gpu, run, sink, observer, times)?,
        }
        Ok(())
    }
}

#[cfg(feature = "gpu")]
fn on_device(
    gpu: &Gpu,
    run: &CellRun,
    sink: Sink,
    observer: &dyn Observer,
    times: &mut RunTimes,
) -> Result<(), BackendError> {
    let compiling = Instant::now();
    let sweeper = Sweeper::new(gpu, run.precision, run.plan.variant())?;
    times.compile += compiling.elapsed();
    let CellRun { plan, grid, cells, .. } = *run;
    let device = match run.precision {
        Precision::F32 => sweeper.sweep_into::<f32>(plan, grid, cells, sink, observer)?.device,
        Precision::F64 => sweeper.sweep_into::<f64>(plan, grid, cells, sink, observer)?.device,
    };
    if let Some(device) = device {
        times.device = Some(times.device.unwrap_or_default() + device);
    }
    Ok(())
}

fn all_by_reference(run: &CellRun, sink: Sink, observer: &dyn Observer) {
    let settings = Settings::default();
    let go_on = || !observer.cancelled();
    let cell = |number: usize| {
        let case = run.grid.case(run.cells.at(number));
        // A sweep that is cancelled has no outcome of the cell.
        if let Some(outcome) = by_reference(run.plan, &case, &settings, &go_on) {
            sink.put(&[number], &[outcome]);
        }
        observer.advance(1);
    };
    parallel::each(run.cells.len(), 1, cell);
}
