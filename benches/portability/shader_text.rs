//! Writes the shader's texts as JSON, with the constants that the host sets and what their kernels need
//! of a device, for other compilers: see `tint.py`.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

use std::collections::BTreeMap;

use naga::AddressSpace;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde_json::{Value, json};
use topple::backend::gpu::pipelines::{WORKGROUP, constants};
use topple::backend::gpu::shader::{self, Switches};
use topple::model::isolation::Variant;
use topple::model::precision::Precision;

/// Switches of a cell that a shader keeps which keeps them.
const EVENTS_KEPT: usize = 8;

/// A pulse on dual isolation, as in the default map.
const PULSE: Variant = Variant {
    isolated_h: true,
    isolated_v: true,
    kinks: true,
    yields: true,
    certificate: true,
    ..Variant::PLAIN
};

/// What the most demanding kernel needs, by the names of WebGPU's limits.
fn needs(source: &str) -> BTreeMap<&'static str, u32> {
    let module = naga::front::wgsl::parse_str(source).unwrap();
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).unwrap();
    let mut needs = BTreeMap::new();
    let mut need = |limit, amount: u32| {
        let most = needs.entry(limit).or_default();
        *most = amount.max(*most);
    };
    for index in 0..module.entry_points.len() {
        let [mut storage, mut uniform, mut shared, mut bindings] = [0; 4];
        for (handle, variable) in module.global_variables.iter() {
            if info.get_entry_point(index)[handle].is_empty() {
                continue;
            }
            let size = module.types[variable.ty].inner.size(module.to_ctx());
            bindings += u32::from(variable.binding.is_some());
            match variable.space {
                AddressSpace::Storage { .. } => storage += 1,
                AddressSpace::Uniform => {
                    uniform += 1;
                    need("maxUniformBufferBindingSize", size);
                }
                AddressSpace::WorkGroup => shared += size,
                _ => {}
            }
        }
        need("maxStorageBuffersPerShaderStage", storage);
        need("maxUniformBuffersPerShaderStage", uniform);
        need("maxBindingsPerBindGroup", bindings);
        need("maxComputeWorkgroupStorageSize", shared);
        need("maxComputeInvocationsPerWorkgroup", WORKGROUP as u32);
        need("maxComputeWorkgroupSizeX", WORKGROUP as u32);
    }
    needs
}

fn text(name: &str, variant: Variant, events_kept: usize) -> Value {
    let switches = if events_kept > 0 { Switches::Kept } else { Switches::Forgotten };
    let source = shader::source(Precision::F32, switches);
    let constants: BTreeMap<_, _> = constants(variant, events_kept).into_iter().collect();
    json!({
        "name": name,
        "needs": needs(&source),
        "source": source,
        "constants": constants,
        "kernels": ["begin", "sweep"],
    })
}

fn main() {
    let rigid = Variant { kinks: false, yields: false, ..PULSE };
    let texts = [
        text("pulse", PULSE, 0),
        text("record", Variant { recorded: true, ..PULSE }, 0),
        text("no isolation", Variant { isolated_h: false, isolated_v: false, ..rigid }, 0),
        text("horizontal isolation", Variant { isolated_v: false, ..PULSE }, 0),
        text("vertical isolation", Variant { isolated_h: false, ..rigid }, 0),
        text("n = 5, no shortcuts", Variant { bouc_wen_n: 5, certificate: false, ..PULSE }, 0),
        text("pulse, switches kept", PULSE, EVENTS_KEPT),
    ];
    println!("{}", json!(texts));
}
