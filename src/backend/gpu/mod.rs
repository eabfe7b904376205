//! The sweep on a GPU, by wgpu: Vulkan, Metal or DX12.
//!
//! A **tile** is the set of cells that are made, run and read together; a device works on several tiles at once. A
//! **dispatch** is a call of the kernel that runs them: each cell gets a number of turns. A **submission** is the set
//! of dispatches that are given to the device together.

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
