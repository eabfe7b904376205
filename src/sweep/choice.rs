//! What a user asks a sweep to run on, and what there is of it.

use serde::{Deserialize, Serialize};
use wgpu::Adapter;

use super::backend::{Backend, Precision};
use super::gpu::GpuError;
use super::gpu::adapter;
use super::gpu::device::Gpu;

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

impl Choice {
    /// The backends for the choice, all alike: as many as there are GPUs of the kind chosen, or as
    /// `adapters` have numbers; one otherwise.
    ///
    /// # Errors
    /// A [`GpuError`] where a GPU was asked for and there is none, or not for this precision.
    pub fn open(self, precision: Precision, adapters: &[usize]) -> Result<Vec<Backend>, GpuError> {
        match self {
            Choice::Cpu => Ok(vec![Backend::Cpu]),
            Choice::Reference => Ok(vec![Backend::Reference]),
            Choice::Gpu => gpus(&adapter::choose(precision, adapters)?),
            Choice::Auto if !adapters.is_empty() => gpus(&adapter::choose(precision, adapters)?),
            Choice::Auto => match adapter::choose(precision, &[]) {
                Ok(chosen) if !adapter::is_software(&chosen[0]) => gpus(&chosen),
                _ => Ok(vec![Backend::Cpu]),
            },
        }
    }
}

fn gpus(adapters: &[Adapter]) -> Result<Vec<Backend>, GpuError> {
    adapters.iter().map(|adapter| Ok(Backend::Gpu(Box::new(Gpu::open(adapter)?)))).collect()
}
