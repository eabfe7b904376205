//! The backend that a user asks for, and the backends that this machine gives for it.

use serde::{Deserialize, Serialize};

use super::backend_error::BackendError;
#[cfg(feature = "gpu")]
use super::gpu::{adapter, opened::Gpu};
use super::ready::Backend;
use crate::model::precision::Precision;
use crate::written;

written! {
    /// The backend that a user requests.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum BackendRequest {
        /// A real GPU, else the CPU.
        Auto = "auto",
        /// A GPU, a software adapter if there is no other.
        Gpu = "gpu",
        /// The CPU.
        Cpu = "cpu",
        /// The adaptive reference, on the CPU, in f64.
        Reference = "reference",
    }
}

/// The backends that a request opened.
pub struct OpenBackends {
    /// One backend, or several equal ones.
    pub backends: Vec<Backend>,
    /// The failures of real GPUs that are listed and not among the backends: they gave no device, or failed the
    /// check.
    pub passed_over: Vec<BackendError>,
}

impl BackendRequest {
    /// The backends for a request, all equal: one for each GPU of the kind chosen, or for each number in `adapters`;
    /// one otherwise. For `auto` a GPU must pass a small check.
    ///
    /// # Errors
    /// A [`BackendError`] where a GPU was requested and there is none, or not for this precision, or it
    /// gives no device.
    pub fn open(
        self,
        precision: Precision,
        adapters: &[usize],
    ) -> Result<OpenBackends, BackendError> {
        if !adapters.is_empty() && matches!(self, BackendRequest::Cpu | BackendRequest::Reference) {
            return Err(BackendError::NoneOfCpu);
        }
        let backends = match self {
            BackendRequest::Cpu => vec![Backend::Cpu],
            BackendRequest::Reference => vec![Backend::Reference],
            BackendRequest::Auto if adapters.is_empty() => {
                return Ok(a_real_gpu_or_the_cpu(precision));
            }
            BackendRequest::Gpu | BackendRequest::Auto => gpus(precision, adapters)?,
        };
        Ok(OpenBackends { backends, passed_over: Vec::new() })
    }
}

#[cfg(feature = "gpu")]
fn gpus(precision: Precision, adapters: &[usize]) -> Result<Vec<Backend>, BackendError> {
    let chosen = adapter::choose(precision, adapters)?;
    chosen.iter().map(|adapter| Gpu::open(adapter).map(gpu)).collect()
}

#[cfg(not(feature = "gpu"))]
fn gpus(_: Precision, _: &[usize]) -> Result<Vec<Backend>, BackendError> {
    Err(BackendError::NotBuilt)
}

#[cfg(feature = "gpu")]
fn a_real_gpu_or_the_cpu(precision: Precision) -> OpenBackends {
    first_that_opens(adapter::real_kinds(precision), |adapter| {
        let able = Gpu::open(&adapter)?;
        able.check(precision)?;
        Ok(gpu(able))
    })
}

#[cfg(not(feature = "gpu"))]
fn a_real_gpu_or_the_cpu(_: Precision) -> OpenBackends {
    OpenBackends { backends: vec![Backend::Cpu], passed_over: Vec::new() }
}

/// Opens the first kind of GPU that has a working device, with all working devices of this kind; else the CPU.
pub fn first_that_opens<T>(
    kinds: Vec<Vec<T>>,
    open: impl Fn(T) -> Result<Backend, BackendError>,
) -> OpenBackends {
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
            return OpenBackends { backends, passed_over };
        }
    }
    OpenBackends { backends: vec![Backend::Cpu], passed_over }
}

#[cfg(feature = "gpu")]
fn gpu(gpu: Gpu) -> Backend {
    Backend::Gpu(Box::new(gpu))
}
