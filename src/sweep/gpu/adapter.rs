//! The adapters of this machine.

use wgpu::{Adapter, Backends, DeviceType, Features, Instance, InstanceDescriptor};

use super::super::backend::Precision;
use super::GpuError;

/// What `topple adapters` shows of an adapter.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Description {
    /// Name of the device.
    pub name: String,
    /// discrete, integrated, virtual, software or other.
    pub kind: String,
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
            kind: kind.into(),
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

/// The most able adapter.
///
/// # Errors
/// Those of [`choose`].
pub fn best(precision: Precision) -> Result<Adapter, GpuError> {
    // As many as one, or an error.
    Ok(choose(precision, &[])?.swap_remove(0))
}

/// The adapters to compute on, all of one kind: those of the numbers given, in the order of [`all`],
/// or else all that are like the most able one. A software adapter is taken if there is no other.
///
/// # Errors
/// [`GpuError::NoAdapter`], [`GpuError::NoSuchAdapter`], [`GpuError::Unlike`], and
/// [`GpuError::NoF64`] where `f64` is asked for.
pub fn choose(precision: Precision, numbers: &[usize]) -> Result<Vec<Adapter>, GpuError> {
    let all = all();
    let Some(best) = all.first() else { return Err(GpuError::NoAdapter) };
    let able =
        |a: &&Adapter| precision == Precision::F32 || a.features().contains(Features::SHADER_F64);
    let chosen: Vec<&Adapter> = if numbers.is_empty() {
        let first = all.iter().find(able).ok_or_else(|| GpuError::NoF64(best.get_info().name))?;
        all.iter().filter(|other| unlike(first, other).is_none()).collect()
    } else {
        let numbered = |&number: &usize| all.get(number).ok_or(GpuError::NoSuchAdapter(number));
        numbers.iter().map(numbered).collect::<Result<_, _>>()?
    };
    if let Some(unable) = chosen.iter().find(|adapter| !able(adapter)) {
        return Err(GpuError::NoF64(unable.get_info().name));
    }
    match chosen.iter().find_map(|other| unlike(chosen[0], other)) {
        Some(error) => Err(error),
        None => Ok(chosen.into_iter().cloned().collect()),
    }
}

/// What is wrong with computing one map on two adapters.
fn unlike(one: &Adapter, other: &Adapter) -> Option<GpuError> {
    let (one, other) = (Description::of(one), Description::of(other));
    let named = |of: Description| format!("{} ({}, {})", of.name, of.api, of.driver);
    (one != other).then(|| GpuError::Unlike(named(one), named(other)))
}
