//! Every parameter of a scene, in words, for captions and panels.

use crate::scene::{Excitation, Overturn, Range, Scene};

/// The parameters of a scene that its axes do not show, each in a few words, always in the same
/// order.
pub fn of(scene: &Scene) -> Vec<String> {
    let block = &scene.block;
    let mut parts = vec![
        format!(
            "B = {} m, H = {} m, M = {} kg, J_C = {} kg m²",
            block.half_width, block.height, block.mass, block.inertia
        ),
        format!("ε = {}", block.eccentricity),
    ];
    let base = &scene.isolation;
    let fixed = |range: &Range| (range.count == 1).then_some(range.start);
    if base.horizontal.is_none() && base.vertical.is_none() {
        parts.push("no isolation".into());
    } else {
        parts.push(format!("m_h = {} kg, m_v = {} kg", base.plate_h, base.plate_v));
    }
    if let Some(law) = &base.horizontal {
        if let Some(t_h) = fixed(&law.t_h) {
            parts.push(format!("T_h = {t_h} s"));
        }
        parts.push(format!(
            "ψ = {}, ξ_h = {}, α_y = {}, n = {}",
            law.psi, law.xi_h, law.alpha_y, law.n
        ));
    }
    if let Some(law) = &base.vertical {
        if let Some(t_v) = fixed(&law.t_v) {
            parts.push(format!("T_v = {t_v} s"));
        }
        parts.push(format!("ξ_v = {}", law.xi_v));
    }
    match &scene.excitation {
        Excitation::Pulse(pulse) => {
            if let Some(omega) = fixed(&pulse.omega) {
                parts.push(format!("Ω = {omega} rad/s"));
            }
            if let Some(a_h) = fixed(&pulse.a_h) {
                parts.push(format!("A_h = {a_h} m/s²"));
            }
            parts.push(format!("A_v = {} m/s²", pulse.a_v));
            parts.push(format!("{} s simulated", scene.t_max));
        }
        Excitation::Record(_) => parts.push("to the end of each record".into()),
    }
    if scene.tilt != 0.0 {
        parts.push(format!("tilt {} rad", scene.tilt));
    }
    if let Some(mu) = scene.friction {
        parts.push(format!("friction {mu}"));
    }
    if let Some(restitution) = scene.restitution {
        parts.push(format!("restitution {restitution}"));
    }
    parts.push(match scene.overturn {
        Overturn::CriticalAngle => "overturned at the critical angle".into(),
        Overturn::QuarterTurn => "overturned at a quarter turn".into(),
    });
    parts
}

/// The parameters that all scenes have, and of each scene the others.
pub fn split<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> (Vec<String>, Vec<Vec<String>>) {
    let all: Vec<Vec<String>> = scenes.into_iter().map(of).collect();
    let common = |part: &String| all.iter().all(|parts| parts.contains(part));
    let shared = all
        .first()
        .map_or(Vec::new(), |parts| parts.iter().filter(|part| common(part)).cloned().collect());
    let own = all
        .iter()
        .map(|parts| parts.iter().filter(|part| !common(part)).cloned().collect())
        .collect();
    (shared, own)
}
