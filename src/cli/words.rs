//! What is said about a run.

use topple::integrate::outcome::Class;
use topple::map::Map;
use topple::sweep::backend::Backend;
use topple::sweep::plan::{Plan, Reductions};
use topple::sweep::verification::Verification;

use super::report::threads;

/// The backend, in a few words.
pub fn backend(backend: &Backend, precision: &str) -> String {
    match backend {
        Backend::Gpu(gpu) => {
            let adapter = &gpu.description;
            format!("gpu, {precision}, {} ({}, {})", adapter.name, adapter.kind, adapter.api)
        }
        Backend::Cpu => {
            let threads = threads();
            format!("cpu, {precision}, {threads} threads")
        }
        Backend::Reference => "reference, f64, adaptive".into(),
    }
}

/// The coordinates that are integrated, and what is left out.
pub fn model(plan: &Plan) -> String {
    let variant = plan.variant();
    let mut state = Vec::new();
    if variant.isolated_h {
        state.push(if variant.yields { "u z" } else { "u" });
    }
    if variant.isolated_v {
        state.push("v");
    }
    state.push("φ");
    let reductions = plan.reductions;
    let mut parts = vec![state.join(" ")];
    if reductions == Reductions::NONE {
        parts.push("nothing left out".into());
    }
    if reductions.certificate {
        parts.push("cells end where energy proves them final".into());
    }
    if reductions.full_contact && plan.scene.tilt == 0.0 {
        parts.push("full contact shared".into());
    }
    parts.join(", ")
}

/// The share of each outcome.
pub fn shares(map: &Map) -> String {
    let total = map.outcomes.len() as f64;
    let mut parts = Vec::new();
    for class in Class::ALL {
        let count = map.count(class);
        if count > 0 {
            let percent = 100.0 * count as f64 / total;
            parts.push(format!("{} {percent:.1} %", class.name().replace('_', " ")));
        }
    }
    let tensile = map.tensile();
    if tensile > 0 {
        let percent = 100.0 * tensile as f64 / total;
        parts.push(format!("contact force tensile in {percent:.1} %"));
    }
    if let (Some(sliding), Some(mu)) = (map.sliding(), map.scene.friction) {
        let percent = 100.0 * sliding as f64 / total;
        parts.push(format!("friction above {mu} asked for in {percent:.1} %"));
    }
    parts.join(", ")
}

/// How the reference's sample came out.
pub fn agreement(v: &Verification) -> String {
    let unresolved = match v.unresolved {
        0 => String::new(),
        count => format!("{count} unresolved, "),
    };
    format!(
        "{} cells again, {} beside a boundary: {unresolved}{} differ in outcome, {} in impacts; \
         t_end within {:.0e} s, zeta within {:.0e}",
        v.sampled, v.beside_boundary, v.differ, v.impacts_differ, v.worst_t_end, v.worst_zeta
    )
}
