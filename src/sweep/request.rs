//! The backend that a user asks for, and the backends that this machine gives for it.

use serde::{Deserialize, Serialize};

use super::backend::Backend;
use super::gpu::opened::Gpu;
use super::gpu::{GpuError, adapter};
use crate::model::precision::Precision;

/// The backend that a user asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum BackendRequest {
    /// A real GPU, else the CPU.
    Auto,
    /// A GPU, a software adapter if there is no other.
    Gpu,
    /// The CPU.
    Cpu,
    /// The adaptive reference, on the CPU, in f64.
    Reference,
}

/// The backends that a request opened.
pub struct Opened {
    /// One backend, or several that are alike.
    pub backends: Vec<Backend>,
    /// Why real GPUs that are listed are not among them: they gave no device, or failed its check.
    pub passed_over: Vec<GpuError>,
}

impl BackendRequest {
    /// The backends for the request, all alike: as many as there are GPUs of the kind chosen, or as
    /// `adapters` have numbers; one otherwise. Of a GPU, `auto` asks that it pass a small check.
    ///
    /// # Errors
    /// A [`GpuError`] where a GPU was asked for and there is none, or not for this precision, or it
    /// gives no device.
    pub fn open(self, precision: Precision, adapters: &[usize]) -> Result<Opened, GpuError> {
        let backends = match self {
            BackendRequest::Cpu => vec![Backend::Cpu],
            BackendRequest::Reference => vec![Backend::Reference],
            BackendRequest::Auto if adapters.is_empty() => {
                return Ok(a_real_gpu_or_the_cpu(precision));
            }
            BackendRequest::Gpu | BackendRequest::Auto => {
                let chosen = adapter::choose(precision, adapters)?;
                chosen
                    .iter()
                    .map(|adapter| Gpu::open(adapter).map(gpu))
                    .collect::<Result<_, _>>()?
            }
        };
        Ok(Opened { backends, passed_over: Vec::new() })
    }
}

fn a_real_gpu_or_the_cpu(precision: Precision) -> Opened {
    first_that_opens(adapter::real_kinds(precision), |adapter| {
        let able = Gpu::open(&adapter)?;
        able.check(precision)?;
        Ok(gpu(able))
    })
}

/// The first kind of GPU of which one at least is opened, with all of it that are; the CPU where none is.
pub fn first_that_opens<T>(
    kinds: Vec<Vec<T>>,
    open: impl Fn(T) -> Result<Backend, GpuError>,
) -> Opened {
    let mut passed_over = Vec::new();
    for kind in kinds {
        let mut backends = Vec::new();
        for adapter in kind {
            match open(adapter) {
                Ok(backend) => backends.push(backend),
                Err(error) => passed_over.push(error),
            }
        }
        if !backends.is_empty() {
            return Opened { backends, passed_over };
        }
    }
    Opened { backends: vec![Backend::Cpu], passed_over }
}

fn gpu(gpu: Gpu) -> Backend {
    Backend::Gpu(Box::new(gpu))
}
