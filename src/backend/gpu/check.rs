//! A check of a device that was chosen automatically: it compiles and runs a small shader and compares the numbers of
//! the device with those of the host.

use wgpu::{
    BindGroupDescriptor, BindGroupEntry, BufferDescriptor, BufferUsages, CommandEncoderDescriptor,
    ComputePassDescriptor, ComputePipelineDescriptor, PipelineCompilationOptions,
    ShaderModuleDescriptor, ShaderSource,
};

use super::BackendError;
use super::device::OpenDevice;
use crate::Written;
use crate::model::precision::Precision;

/// The number of results of the shader, one from each thread.
const COUNT: u32 = 64;

/// The text of the shader.
pub fn source(precision: Precision) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read_write> numbers: array<f32>;
         @compute @workgroup_size({COUNT})
         fn check(@builtin(global_invocation_id) id: vec3<u32>) {{
             let number = {0}(id.x) * {0}(0.25) + {0}(3.0);
             numbers[id.x] = f32(number);
         }}",
        precision.key()
    )
}

impl OpenDevice {
    /// Runs a shader of a few lines and compares its numbers with those of the host. The check takes some
    /// milliseconds.
    ///
    /// # Errors
    /// [`BackendError::FailedCheck`].
    pub fn check(&self, precision: Precision) -> Result<(), BackendError> {
        self.check_by(&source(precision))
    }

    /// The check by a shader given as text, for example a wrong one.
    ///
    /// # Errors
    /// [`BackendError::FailedCheck`].
    pub fn check_by(&self, source: &str) -> Result<(), BackendError> {
        let failed = |reason: String| BackendError::FailedCheck {
            adapter: self.description.name.clone(),
            reason,
        };
        let bytes = self.pass(source).map_err(|error| failed(error.to_string()))?;
        let numbers: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
        // Every product and sum is exact in both precisions.
        let right = (0..COUNT).map(|k| k as f32 * 0.25 + 3.0);
        if numbers.len() == COUNT as usize && numbers.iter().copied().eq(right) {
            Ok(())
        } else {
            Err(failed("its numbers are wrong".into()))
        }
    }

    /// The bytes that the shader has written.
    fn pass(&self, source: &str) -> Result<Vec<u8>, BackendError> {
        let device = &self.device;
        let pipeline = self.checked(|| {
            let module = device.create_shader_module(ShaderModuleDescriptor {
                label: Some("check"),
                source: ShaderSource::Wgsl(source.into()),
            });
            device.create_compute_pipeline(&ComputePipelineDescriptor {
                label: Some("check"),
                layout: None,
                module: &module,
                entry_point: Some("check"),
                compilation_options: PipelineCompilationOptions::default(),
                cache: None,
            })
        })?;
        let back = self.checked(|| {
            let buffer = |usage| {
                device.create_buffer(&BufferDescriptor {
                    label: Some("check"),
                    size: u64::from(COUNT) * 4,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let numbers = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
            let back = buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ);
            let group = device.create_bind_group(&BindGroupDescriptor {
                label: Some("check"),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[BindGroupEntry { binding: 0, resource: numbers.as_entire_binding() }],
            });
            let mut encoder =
                device.create_command_encoder(&CommandEncoderDescriptor { label: Some("check") });
            {
                let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
                    label: Some("check"),
                    timestamp_writes: None,
                });
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.dispatch_workgroups(1, 1, 1);
            }
            encoder.copy_buffer_to_buffer(&numbers, 0, &back, 0, None);
            self.queue.submit([encoder.finish()]);
            back
        })?;
        self.map(&[&back], None)?;
        let bytes = self.view(&back)?.to_vec();
        Ok(bytes)
    }
}
