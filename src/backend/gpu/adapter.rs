//! The adapters of this machine.

#[cfg(any(target_os = "linux", target_os = "freebsd"))]
use std::ffi::CStr;

use wgpu::{Adapter, AdapterInfo, Backends, DeviceType, Features, Instance};

use super::super::description::AdapterDescription;
use super::BackendError;
use crate::model::precision::Precision;

/// The interfaces that the shader is compiled for.
const BACKENDS: Backends = Backends::VULKAN.union(Backends::METAL).union(Backends::DX12);

impl AdapterDescription {
    /// Describes an adapter.
    pub fn of(adapter: &Adapter) -> AdapterDescription {
        let info = adapter.get_info();
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => "discrete",
            DeviceType::IntegratedGpu => "integrated",
            DeviceType::VirtualGpu => "virtual",
            DeviceType::Cpu => "software",
            DeviceType::Other => "other",
        };
        AdapterDescription {
            name: info.name,
            kind: kind.into(),
            api: format!("{:?}", info.backend),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_string(),
            f64: is_able(adapter, Precision::F64),
        }
    }
}

/// All adapters that can compute, the best first: real GPUs before software, then those with f64.
pub fn all() -> Vec<Adapter> {
    let Some(instance) = instance() else { return Vec::new() };
    let mut adapters = pollster::block_on(instance.enumerate_adapters(BACKENDS));
    adapters.retain(|adapter| adapter.limits().max_compute_workgroup_size_x >= 64);
    once(&mut adapters, Adapter::get_info);
    adapters.sort_by_key(|adapter| {
        let kind = match adapter.get_info().device_type {
            DeviceType::DiscreteGpu => 0,
            DeviceType::IntegratedGpu => 1,
            DeviceType::VirtualGpu => 2,
            DeviceType::Other => 3,
            DeviceType::Cpu => 4,
        };
        (kind, !is_able(adapter, Precision::F64))
    });
    adapters
}

/// Keeps the first of all adapters that are the same device.
fn once<T>(adapters: &mut Vec<T>, info: impl Fn(&T) -> AdapterInfo) {
    let mut known: Vec<AdapterInfo> = Vec::with_capacity(adapters.len());
    adapters.retain(|adapter| {
        let own = info(adapter);
        let is_new = !known.iter().any(|other| is_one(other, &own));
        known.extend(is_new.then_some(own));
        is_new
    });
}

/// True of two adapters that are one device. Vulkan lists a device twice where two manifests name one driver. Two
/// cards of one kind have different places on the PCI bus. Software has no place there, and the processor is the same
/// device in each listing. The other interfaces list each device once, and tell either no place on the bus or, for
/// cards of one kind, the place of the first card.
fn is_one(one: &AdapterInfo, other: &AdapterInfo) -> bool {
    let told = |info: &AdapterInfo| {
        let AdapterInfo { name, vendor, device, device_pci_bus_id, .. } = info;
        let driver = (info.driver.clone(), info.driver_info.clone());
        (info.device_type, *vendor, *device, name.clone(), device_pci_bus_id.clone(), driver)
    };
    [one, other].iter().all(|info| info.backend == wgpu::Backend::Vulkan)
        && told(one) == told(other)
}

/// The access to the drivers: none without a Vulkan loader.
///
/// No windows of Wayland or X11 are requested of Vulkan. Mesa's layer for choosing a device connects to
/// the window system of a program that asks for its windows, and libwayland complains on stderr where
/// XDG_RUNTIME_DIR is not set, as over ssh and in containers.
#[cfg(any(target_os = "linux", target_os = "freebsd"))]
fn instance() -> Option<Instance> {
    use wgpu::hal::{InstanceDescriptor, api::Vulkan, vulkan};

    const WINDOWS: [&CStr; 3] =
        [c"VK_KHR_wayland_surface", c"VK_KHR_xcb_surface", c"VK_KHR_xlib_surface"];
    let usual = wgpu::InstanceDescriptor::new_without_display_handle();
    let descriptor = InstanceDescriptor {
        name: "topple",
        flags: usual.flags,
        memory_budget_thresholds: usual.memory_budget_thresholds,
        backend_options: usual.backend_options,
        telemetry: None,
        display: None,
    };
    // SAFETY: wgpu-hal requires the complete list of extensions because it uses what is listed. It uses these three
    // in `create_surface` alone, and only where they are listed; no surface can be made of this instance, which does
    // not leave this file.
    let vulkan = unsafe {
        vulkan::Instance::init_with_callback(
            &descriptor,
            Some(Box::new(|arguments| arguments.extensions.retain(|name| !WINDOWS.contains(name)))),
        )
    };
    // SAFETY: the instance was made above, and nothing else refers to it.
    vulkan.ok().map(|vulkan| unsafe { Instance::from_hal::<Vulkan>(vulkan) })
}

/// The access to the drivers.
#[cfg(not(any(target_os = "linux", target_os = "freebsd")))]
fn instance() -> Option<Instance> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = BACKENDS;
    Some(Instance::new(descriptor))
}

/// True for a software adapter: it computes on the processor.
pub fn is_software(adapter: &Adapter) -> bool {
    adapter.get_info().device_type == DeviceType::Cpu
}

/// The best adapter.
///
/// # Errors
/// Those of [`choose`].
pub fn best(precision: Precision) -> Result<Adapter, BackendError> {
    // The list has one adapter at least, or there is an error.
    Ok(choose(precision, &[])?.swap_remove(0))
}

/// The adapters to compute on, all of one kind: those with the given numbers, in the order of [`all`], or else all
/// that are like the best one. A software adapter is taken only if there is no other.
///
/// # Errors
/// [`BackendError::NoAdapter`], [`BackendError::NoSuchAdapter`], [`BackendError::Unlike`], and
/// [`BackendError::NoF64`] where `f64` is requested.
pub fn choose(precision: Precision, numbers: &[usize]) -> Result<Vec<Adapter>, BackendError> {
    let all = all();
    let Some(best) = all.first() else { return Err(BackendError::NoAdapter) };
    if numbers.is_empty() {
        let name = best.get_info().name;
        let mut kinds = kinds_of(all, precision);
        return if kinds.is_empty() {
            Err(BackendError::NoF64(name))
        } else {
            Ok(kinds.swap_remove(0))
        };
    }
    let numbered = |&number: &usize| all.get(number).ok_or(BackendError::NoSuchAdapter(number));
    let chosen: Vec<&Adapter> = numbers.iter().map(numbered).collect::<Result<_, _>>()?;
    if let Some(unable) = chosen.iter().find(|adapter| !is_able(adapter, precision)) {
        return Err(BackendError::NoF64(unable.get_info().name));
    }
    match chosen.iter().find_map(|other| unlike(chosen[0], other)) {
        Some(error) => Err(error),
        None => Ok(chosen.into_iter().cloned().collect()),
    }
}

/// The real GPUs that compute in a precision, in groups of equal ones, the best first.
pub fn real_kinds(precision: Precision) -> Vec<Vec<Adapter>> {
    let mut kinds = kinds_of(all(), precision);
    kinds.retain(|kind| !is_software(&kind[0]));
    kinds
}

/// The adapters that compute in a precision, in groups of equal ones; no group is empty.
fn kinds_of(adapters: Vec<Adapter>, precision: Precision) -> Vec<Vec<Adapter>> {
    let mut kinds: Vec<Vec<Adapter>> = Vec::new();
    for adapter in adapters.into_iter().filter(|adapter| is_able(adapter, precision)) {
        match kinds.iter_mut().find(|kind| unlike(&kind[0], &adapter).is_none()) {
            Some(kind) => kind.push(adapter),
            None => kinds.push(vec![adapter]),
        }
    }
    kinds
}

/// True for an adapter that computes in a precision.
fn is_able(adapter: &Adapter, precision: Precision) -> bool {
    precision == Precision::F32 || adapter.features().contains(Features::SHADER_F64)
}

/// The reason why one map cannot be computed on two adapters.
fn unlike(one: &Adapter, other: &Adapter) -> Option<BackendError> {
    let (one, other) = (AdapterDescription::of(one), AdapterDescription::of(other));
    let named = |of: AdapterDescription| format!("{} ({}, {})", of.name, of.api, of.driver);
    (one != other).then(|| BackendError::Unlike(named(one), named(other)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn card(api: wgpu::Backend, name: &str, pci: &str) -> AdapterInfo {
        AdapterInfo {
            name: name.into(),
            vendor: 0x10de,
            device: 0x2330,
            device_pci_bus_id: pci.into(),
            driver: "driver".into(),
            ..AdapterInfo::new(DeviceType::DiscreteGpu, api)
        }
    }

    /// The numbers of the adapters that are kept.
    fn left(infos: &[AdapterInfo]) -> Vec<usize> {
        let mut numbers: Vec<usize> = (0..infos.len()).collect();
        once(&mut numbers, |number| infos[*number].clone());
        numbers
    }

    #[test]
    fn a_device_that_two_manifests_name_counts_once_and_two_cards_of_a_kind_twice() {
        use wgpu::Backend::{Dx12, Metal, Vulkan};
        let first = card(Vulkan, "H100", "0000:17:00.0");
        let second = card(Vulkan, "H100", "0000:65:00.0");
        let software = AdapterInfo { device_type: DeviceType::Cpu, ..card(Vulkan, "llvmpipe", "") };
        let newer = AdapterInfo { driver_info: "Mesa 26".into(), ..software.clone() };
        let all = [&first, &software, &second, &software, &first, &second, &newer];
        assert_eq!(left(&all.map(Clone::clone)), [0, 1, 2, 6]);
        // Two Vulkan adapters without a place on the bus are one device; other interfaces list each device once.
        assert_eq!(left(&[card(Vulkan, "H100", ""), card(Vulkan, "H100", "")]), [0]);
        for (api, pci) in [(Metal, ""), (Dx12, "0000:17:00.0")] {
            assert_eq!(left(&[card(api, "Pro", pci), card(api, "Pro", pci)]), [0, 1]);
        }
    }
}
