//! What a sweep runs on.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::cells::Plan;
use super::cpu;
use super::gpu::GpuError;
use super::gpu::adapter::{self, Description};
use super::gpu::device::Gpu;
use super::gpu::run::Sweeper;
use crate::integrate::outcome::{Outcome, Status};
use crate::integrate::reference;
use crate::scene::Grid;

/// Number type of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 32 bits.
    F32,
    /// 64 bits.
    F64,
}

/// The backend that a user asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Choice {
    /// A real GPU, else the CPU.
    Auto,
    /// A GPU, a software adapter if there is no other.
    Gpu,
    /// The CPU.
    Cpu,
    /// The adaptive reference, on the CPU, in f64.
    Reference,
}

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
}

impl Backend {
    /// The backend for a choice.
    ///
    /// # Errors
    /// A [`GpuError`] where a GPU was asked for and there is none, or not for this precision.
    pub fn choose(choice: Choice, precision: Precision) -> Result<Backend, GpuError> {
        match choice {
            Choice::Cpu => Ok(Backend::Cpu),
            Choice::Reference => Ok(Backend::Reference),
            Choice::Gpu => {
                let adapter = adapter::choose(precision)?;
                Ok(Backend::Gpu(Box::new(Gpu::open(&adapter)?)))
            }
            Choice::Auto => match adapter::choose(precision) {
                Ok(adapter) if !adapter::is_software(&adapter) => {
                    Ok(Backend::Gpu(Box::new(Gpu::open(&adapter)?)))
                }
                _ => Ok(Backend::Cpu),
            },
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

    /// Runs all cells of a grid; `progress` hears of cells as they are done.
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
        let began = Instant::now();
        let mut compile = Duration::ZERO;
        let mut outcomes: Vec<Option<Outcome>> = vec![None; grid.len()];
        for part in plan.at(precision).parts(grid) {
            let (plan, cells) = (&part.plan, part.cells.as_slice());
            let swept = match (self, precision) {
                (Backend::Gpu(gpu), _) => {
                    let compiling = Instant::now();
                    let sweeper = Sweeper::new(gpu, precision, plan.variant())?;
                    compile += compiling.elapsed();
                    match precision {
                        Precision::F32 => sweeper.sweep::<f32>(plan, grid, cells, progress)?,
                        Precision::F64 => sweeper.sweep::<f64>(plan, grid, cells, progress)?,
                    }
                }
                (Backend::Cpu, Precision::F32) => cpu::sweep::<f32>(plan, grid, cells, progress),
                (Backend::Cpu, Precision::F64) => cpu::sweep::<f64>(plan, grid, cells, progress),
                (Backend::Reference, _) => by_reference(plan, grid, cells, progress),
            };
            for (&index, mut outcome) in cells.iter().zip(swept) {
                if part.vertical_locked && outcome.status == Status::Ok {
                    outcome.status = Status::VerticalLocked;
                }
                outcomes[index] = Some(outcome);
            }
        }
        // The parts of a plan hold every cell once.
        let outcomes = outcomes.into_iter().flatten().collect();
        Ok(Swept { outcomes, elapsed: began.elapsed() - compile, compile })
    }
}

fn by_reference(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    progress: &(dyn Fn(usize) + Sync),
) -> Vec<Outcome> {
    let settings = reference::Settings::default();
    let run = |&index: &usize| {
        let outcome = reference::run(&plan.scene, &grid.point(index), &settings);
        progress(1);
        outcome
    };
    cells.par_iter().map(run).collect()
}
