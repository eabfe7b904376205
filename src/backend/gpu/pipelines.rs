//! The compiled shader: one kernel makes cells, the other runs them.

use wgpu::{
    ComputePipeline, ComputePipelineDescriptor, PipelineCompilationOptions, ShaderModuleDescriptor,
    ShaderSource,
};

use super::BackendError;
use super::device::OpenDevice;
use crate::model::isolation::Variant;

/// The number of threads of a workgroup.
pub const WORKGROUP: usize = 64;

/// The two kernels.
#[derive(Debug, Clone)]
pub struct Pipelines {
    /// Makes the cells of a tile.
    pub begin: ComputePipeline,
    /// Runs the turns of a dispatch.
    pub sweep: ComputePipeline,
}

/// The override constants of the text of a shader, for a variant of the model.
pub fn constants(variant: Variant, events_kept: usize) -> Vec<(&'static str, f64)> {
    let mut constants = vec![
        ("recorded", f64::from(u8::from(variant.recorded))),
        ("pulse_shape", f64::from(variant.pulse as u8)),
        ("cycles", f64::from(u8::from(variant.cycles))),
        ("isolated_h", f64::from(u8::from(variant.isolated_h))),
        ("isolated_v", f64::from(u8::from(variant.isolated_v))),
        ("kinks", f64::from(u8::from(variant.kinks))),
        ("yields", f64::from(u8::from(variant.yields))),
        ("certificate", f64::from(u8::from(variant.certificate))),
        ("angles", f64::from(u8::from(variant.asked.angles))),
        ("displacements", f64::from(u8::from(variant.asked.displacements))),
        ("forces", f64::from(u8::from(variant.asked.forces))),
        ("accelerations", f64::from(u8::from(variant.asked.accelerations))),
        ("stop_values", f64::from(u8::from(variant.asked.stops))),
        ("follows", f64::from(u8::from(variant.follows))),
        ("stops", f64::from(u8::from(variant.stops))),
        ("hardens", f64::from(u8::from(variant.hardens))),
        ("bodies", f64::from(u8::from(variant.bodies))),
        ("bouc_wen_n", f64::from(variant.bouc_wen_n)),
        ("workgroup_size", WORKGROUP as f64),
    ];
    if events_kept > 0 {
        constants.push(("events_kept", events_kept as f64));
    }
    constants
}

/// Compiles the text of a shader for a variant of the model.
///
/// # Errors
/// [`BackendError::Refused`].
pub fn compile(
    gpu: &OpenDevice,
    source: &str,
    variant: Variant,
    events_kept: usize,
) -> Result<Pipelines, BackendError> {
    let constants = constants(variant, events_kept);
    gpu.checked(|| {
        let module = gpu.device.create_shader_module(ShaderModuleDescriptor {
            label: Some("sweep"),
            source: ShaderSource::Wgsl(source.into()),
        });
        let kernel = |name| {
            gpu.device.create_compute_pipeline(&ComputePipelineDescriptor {
                label: Some(name),
                layout: None,
                module: &module,
                entry_point: Some(name),
                compilation_options: PipelineCompilationOptions {
                    constants: &constants,
                    ..PipelineCompilationOptions::default()
                },
                cache: None,
            })
        };
        Pipelines { begin: kernel("begin"), sweep: kernel("sweep") }
    })
}
