//! An open device, and all kinds of its failures.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};

use wgpu::{
    Adapter, Buffer, BufferView, Device, DeviceDescriptor, ErrorFilter, ExperimentalFeatures,
    Features, MemoryHints, PollType, Queue, SubmissionIndex, Trace,
};

use super::super::description::AdapterDescription;
use super::BackendError;

/// An open device.
pub struct OpenDevice {
    /// The device.
    pub device: Device,
    /// Its queue.
    pub queue: Queue,
    /// The description of its adapter.
    pub description: AdapterDescription,
    /// The first failure that was reported outside of a call.
    failure: Arc<Mutex<Option<BackendError>>>,
}

impl OpenDevice {
    /// Opens a device with the largest limits of its adapter, and with `f64` and time stamps where the adapter has
    /// them.
    ///
    /// # Errors
    /// [`BackendError::NoDevice`].
    pub fn open(adapter: &Adapter) -> Result<OpenDevice, BackendError> {
        let description = AdapterDescription::of(adapter);
        let wanted = Features::SHADER_F64 | Features::TIMESTAMP_QUERY;
        let descriptor = DeviceDescriptor {
            label: Some("topple"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            experimental_features: ExperimentalFeatures::disabled(),
            memory_hints: MemoryHints::Performance,
            trace: Trace::Off,
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
                BackendError::NoDevice {
                    adapter: description.name.clone(),
                    reason: error.to_string(),
                }
            })?;
        let failure = Arc::new(Mutex::new(None));
        let lost = Arc::clone(&failure);
        device.set_device_lost_callback(move |reason, message| {
            note(&lost, BackendError::Lost(format!("{reason:?} {message}").trim().to_string()));
        });
        let uncaptured = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |error| note(&uncaptured, refusal(error))));
        Ok(OpenDevice { device, queue, description, failure })
    }

    /// True where the device can measure the time of a pass.
    pub fn has_clock(&self) -> bool {
        self.device.features().contains(Features::TIMESTAMP_QUERY)
    }

    /// Runs `commands` and reports which of them the device refused.
    ///
    /// # Errors
    /// [`BackendError::OutOfMemory`] and [`BackendError::Refused`].
    pub fn checked<T>(&self, commands: impl FnOnce() -> T) -> Result<T, BackendError> {
        let memory = self.device.push_error_scope(ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(ErrorFilter::Validation);
        let internal = self.device.push_error_scope(ErrorFilter::Internal);
        let result = commands();
        let errors = [
            pollster::block_on(internal.pop()),
            pollster::block_on(validation.pop()),
            pollster::block_on(memory.pop()),
        ];
        match errors.into_iter().flatten().next() {
            Some(error) => Err(refusal(error)),
            None => Ok(result),
        }
    }

    /// Waits until the device has finished the submitted work: all of it, or up to one submission.
    ///
    /// # Errors
    /// [`BackendError::Lost`], and any failure noted since the last call.
    pub fn wait(&self, submission: Option<SubmissionIndex>) -> Result<(), BackendError> {
        let until = PollType::Wait { submission_index: submission, timeout: None };
        // wgpu panics where the device fails during a wait; for the caller this is a lost device like any other.
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(until)));
        if let Some(failure) = self.failure.lock().ok().and_then(|mut failure| failure.take()) {
            return Err(failure);
        }
        match polled {
            Ok(Ok(_)) => Ok(()),
            Ok(Err(error)) => Err(BackendError::Lost(error.to_string())),
            Err(_) => Err(BackendError::Lost("the driver failed while it was waited for".into())),
        }
    }

    /// Maps buffers after the device has finished one submission, or all of them.
    ///
    /// # Errors
    /// As [`OpenDevice::wait`], and [`BackendError::Lost`] where a buffer cannot be mapped.
    pub fn map(
        &self,
        buffers: &[&Buffer],
        submission: Option<SubmissionIndex>,
    ) -> Result<(), BackendError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        for buffer in buffers {
            let sender = sender.clone();
            buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
                // The receiver is gone only if `wait` failed, which is the error to report.
                let _ = sender.send(mapped);
            });
        }
        self.wait(submission)?;
        for _ in buffers {
            match receiver.try_recv() {
                Ok(Ok(())) => {}
                Ok(Err(error)) => return Err(BackendError::Lost(error.to_string())),
                Err(_) => return Err(BackendError::Lost("a result was never delivered".into())),
            }
        }
        Ok(())
    }

    /// The bytes of a mapped buffer.
    ///
    /// # Errors
    /// [`BackendError::Lost`].
    pub fn view(&self, buffer: &Buffer) -> Result<BufferView, BackendError> {
        buffer.get_mapped_range(..).map_err(|error| BackendError::Lost(error.to_string()))
    }
}

fn note(place: &Mutex<Option<BackendError>>, failure: BackendError) {
    if let Ok(mut place) = place.lock() {
        place.get_or_insert(failure);
    }
}

fn refusal(error: wgpu::Error) -> BackendError {
    match error {
        wgpu::Error::OutOfMemory { source } => BackendError::OutOfMemory(source.to_string()),
        other => BackendError::Refused(
            other.to_string().split_whitespace().collect::<Vec<_>>().join(" "),
        ),
    }
}
