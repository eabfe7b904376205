//! The sweep on a GPU, by wgpu: Vulkan, Metal or DX12.
//!
//! A **tile** is the cells that are made, run and read together; a device has two in work at once. A **dispatch** is a call
//! of the kernel that runs them: each cell gets a stretch of turns. A **submission** is the dispatches that are handed to
//! the device together.

pub mod adapter;
pub mod check;
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
mod submission;
pub mod tile;
mod tiles;

pub(crate) use super::backend_error::BackendError;
