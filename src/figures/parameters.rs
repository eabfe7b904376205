//! Every parameter of a scene, in words, for captions and panels.

use crate::scene::{Directions, Excitation, Overturn, Parameter, Scene};

/// What a line of a caption holds together.
const LINES: [&[Parameter]; 15] = [
    &[
        Parameter::HalfWidth,
        Parameter::Height,
        Parameter::Slenderness,
        Parameter::Size,
        Parameter::Mass,
        Parameter::Inertia,
    ],
    &[Parameter::Eccentricity, Parameter::Offset],
    &[Parameter::PlateH, Parameter::PlateV],
    &[Parameter::TH],
    &[
        Parameter::Psi,
        Parameter::XiH,
        Parameter::AlphaY,
        Parameter::UY,
        Parameter::YieldForce,
        Parameter::BoucWenN,
    ],
    &[Parameter::TV],
    &[Parameter::XiV],
    &[Parameter::Omega],
    &[Parameter::AH],
    &[Parameter::AV],
    &[Parameter::Cycles],
    &[Parameter::Gamma, Parameter::Phase],
    &[Parameter::Scale, Parameter::Pga],
    &[Parameter::Friction],
    &[Parameter::Restitution],
];

/// The parameters of a scene that its axes do not show, each in a few words, always in the same
/// order.
pub fn of(scene: &Scene) -> Vec<String> {
    let isolated = scene.isolation != Directions::None;
    let mut parts = Vec::new();
    for line in LINES {
        if line.contains(&Parameter::Omega)
            && let Some(pulse) = scene.excitation.other_pulse()
        {
            parts.push(pulse.into());
        }
        if line.contains(&Parameter::PlateH) && !isolated {
            parts.push("no isolation".into());
            continue;
        }
        let words = |parameter: &Parameter| {
            let value = scene.numbers.get(*parameter)?.single()?;
            Some(parameter.entry().written(value))
        };
        let words: Vec<String> = line.iter().filter_map(words).collect();
        if !words.is_empty() {
            parts.push(words.join(", "));
        }
    }
    match (&scene.excitation, scene.numbers.get(Parameter::TMax)) {
        (Excitation::Record(_), _) => parts.push("to the end of each record".into()),
        (Excitation::Pulse(_), Some(t_max)) if t_max.count() == 1 => {
            parts.push(format!("{t_max} s simulated"));
        }
        _ => {}
    }
    if let Some(tilt) = scene.numbers.get(Parameter::Tilt).and_then(|tilt| tilt.single())
        && tilt != 0.0
    {
        parts.push(Parameter::Tilt.entry().written(tilt));
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
