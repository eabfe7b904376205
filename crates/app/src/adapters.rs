//! `topple adapters`.

use super::print::print_line;
use topple::backend::description::AdapterDescription;
use topple::backend::gpu::adapter;

/// Lists the adapters, the one that `--backend gpu` takes first.
pub fn run() -> anyhow::Result<()> {
    let adapters = adapter::all();
    if adapters.is_empty() {
        print_line!("no GPU adapter (Vulkan, Metal, DX12) was found; topple computes on the CPU");
        return Ok(());
    }
    print_line!("{:>2}  {:<44} {:<10} {:<7} {:<8} driver", "", "adapter", "kind", "api", "numbers");
    for (number, adapter) in adapters.iter().enumerate() {
        let AdapterDescription { name, kind, api, driver, f64 } = AdapterDescription::of(adapter);
        let numbers = if f64 { "f32 f64" } else { "f32" };
        print_line!("{number:>2}  {name:<44} {kind:<10} {api:<7} {numbers:<8} {driver}");
    }
    if adapters.iter().all(adapter::is_software) {
        print_line!("\nonly software adapters: --backend auto computes on the CPU");
    }
    Ok(())
}
