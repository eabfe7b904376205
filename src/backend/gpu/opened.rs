//! An open GPU: its device, with the compiled sweeps and the buffers that the next sweep uses again.

use std::ops::Deref;
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
    /// The compiled sweeps: only the first tile waits for the compiler.
    pipelines: Mutex<Vec<(Key, Pipelines)>>,
    /// Places for cells, used again by the next sweep.
    slots: Mutex<Option<Slots>>,
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
    /// Opens an adapter's device.
    ///
    /// # Errors
    /// [`BackendError::NoDevice`].
    pub fn open(adapter: &Adapter) -> Result<Gpu, BackendError> {
        let device = OpenDevice::open(adapter)?;
        Ok(Gpu { device, pipelines: Mutex::default(), slots: Mutex::default() })
    }

    /// The compiled sweep for a number type and a variant, compiled by `compile` the first time.
    ///
    /// # Errors
    /// Those of `compile`.
    pub fn pipelines(
        &self,
        key: Key,
        compile: impl FnOnce() -> Result<Pipelines, BackendError>,
    ) -> Result<Pipelines, BackendError> {
        // Where a thread broke off there is no half-made entry: the list is as it was.
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = pipelines.iter().find(|(known, _)| *known == key) {
            return Ok(known.clone());
        }
        let compiled = compile()?;
        pipelines.push((key, compiled.clone()));
        Ok(compiled)
    }

    /// The places for cells that the last sweep left, where they suit.
    pub fn slots(&self, suit: impl FnOnce(&Slots) -> bool) -> Option<Slots> {
        let mut slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        // Places that do not suit are freed before new ones take memory.
        slots.take().filter(suit)
    }

    /// Keeps places for the cells of the next sweep.
    pub fn keep(&self, slots: Slots) {
        *self.slots.lock().unwrap_or_else(PoisonError::into_inner) = Some(slots);
    }
}
