//! The adapters of this machine.

use wgpu::{Adapter, Backends, DeviceType, Features, Instance, InstanceDescriptor};

use super::super::backend::Precision;
use super::GpuError;

/// What `topple adapters` shows of an adapter.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Description {
    /// Name of the device.
    pub name: String,
    /// discrete, integrated, virtual, software or other.
    pub kind: &'static str,
    /// Vulkan, Metal or Dx12.
    pub api: String,
    /// Driver and its version.
    pub driver: String,
    /// It computes in double precision.
    pub f64: bool,
}

impl Description {
    /// Describes an adapter.
    pub fn of(adapter: &Adapter) -> Description {
        let info = adapter.get_info();
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => "discrete",
            DeviceType::IntegratedGpu => "integrated",
            DeviceType::VirtualGpu => "virtual",
            DeviceType::Cpu => "software",
            DeviceType::Other => "other",
        };
        Description {
            name: info.name,
            kind,
            api: format!("{:?}", info.backend),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_string(),
            f64: adapter.features().contains(Features::SHADER_F64),
        }
    }
}

/// All adapters that can compute, the most able first.
pub fn all() -> Vec<Adapter> {
    let backends = Backends::VULKAN | Backends::METAL | Backends::DX12;
    let mut descriptor = InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let instance = Instance::new(descriptor);
    let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
    adapters.retain(|adapter| adapter.limits().max_compute_workgroup_size_x >= 64);
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    });
    adapters
}

/// True for an adapter that is a processor in disguise.
pub fn is_software(adapter: &Adapter) -> bool {
    adapter.get_info().device_type == DeviceType::Cpu
}

/// The adapter to compute on, a software one if there is no other.
///
/// # Errors
/// [`GpuError::NoAdapter`], and [`GpuError::NoF64`] where `f64` is asked for.
pub fn choose(precision: Precision) -> Result<Adapter, GpuError> {
    let mut adapters = all();
    if adapters.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let able =
        |a: &Adapter| precision == Precision::F32 || a.features().contains(Features::SHADER_F64);
    match adapters.iter().position(able) {
        Some(first) => Ok(adapters.swap_remove(first)),
        None => Err(GpuError::NoF64(adapters[0].get_info().name)),
    }
}
