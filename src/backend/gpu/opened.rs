//! An open GPU: its device, the compiled sweeps, and the buffers that the next sweep uses again.

use std::ops::Deref;
use std::sync::atomic::AtomicUsize;
use std::sync::{Mutex, PoisonError};

use wgpu::Adapter;

use super::BackendError;
use super::device::OpenDevice;
use super::pipelines::Pipelines;
use super::slots::Slots;
use crate::model::isolation::Variant;
use crate::model::precision::Precision;

/// An open GPU.
pub struct Gpu {
    device: OpenDevice,
    /// The compiled sweeps: only the first tile of a sweep waits for the compiler.
    pipelines: Mutex<Vec<(Key, Pipelines)>>,
    /// The buffers for cells, which the next sweep uses again.
    slots: Mutex<Option<Slots>>,
    /// The most cells of a tile for which the device had memory, where it had none for more.
    pub most_cells: AtomicUsize,
}

/// The number type and the variant of a compiled sweep.
type Key = (Precision, Variant);

impl Deref for Gpu {
    type Target = OpenDevice;

    fn deref(&self) -> &OpenDevice {
        &self.device
    }
}

impl Gpu {
    /// Opens the device of an adapter.
    ///
    /// # Errors
    /// [`BackendError::NoDevice`].
    pub fn open(adapter: &Adapter) -> Result<Gpu, BackendError> {
        let device = OpenDevice::open(adapter)?;
        let (pipelines, slots) = (Mutex::default(), Mutex::default());
        Ok(Gpu { device, pipelines, slots, most_cells: AtomicUsize::new(usize::MAX) })
    }

    /// The compiled sweep for a number type and a variant; `compile` makes it the first time.
    ///
    /// # Errors
    /// Those of `compile`.
    pub fn pipelines(
        &self,
        key: Key,
        compile: impl FnOnce() -> Result<Pipelines, BackendError>,
    ) -> Result<Pipelines, BackendError> {
        // If a thread panicked here, the list has no incomplete entry.
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = pipelines.iter().find(|(known, _)| *known == key) {
            return Ok(known.clone());
        }
        let compiled = compile()?;
        pipelines.push((key, compiled.clone()));
        Ok(compiled)
    }

    /// The buffers for cells that the last sweep left, if they are suitable.
    pub fn slots(&self, suit: impl FnOnce(&Slots) -> bool) -> Option<Slots> {
        let mut slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        // Unsuitable buffers are freed before new ones take memory.
        slots.take().filter(suit)
    }

    /// Keeps the buffers for the cells of the next sweep.
    pub fn keep(&self, slots: Slots) {
        *self.slots.lock().unwrap_or_else(PoisonError::into_inner) = Some(slots);
    }
}
