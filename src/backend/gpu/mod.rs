//! The sweep on a GPU, by wgpu: Vulkan, Metal or DX12.

pub mod adapter;
pub mod check;
mod chunk;
pub(crate) mod device;
pub(crate) mod inputs;
pub(crate) mod listed;
mod loaded;
mod made;
pub mod opened;
pub mod outcomes;
pub mod pace;
pub mod pipelines;
pub mod run;
pub mod shader;
pub mod slots;
pub mod tile;
mod tiles;

pub(crate) use super::backend_error::BackendError;
