//! Every parameter of a scene, in words, for captions and panels.

use topple::scene::parameters::{Entry, PARAMETERS, Section};
use topple::scene::{Directions, Excitation, Overturn, Parameter, Scene};

/// The parameters of a scene that its axes do not show, each in a few words, in the order of the table.
pub fn of(scene: &Scene) -> Vec<String> {
    let single = |entry: &Entry| scene.numbers.get(entry.parameter)?.single();
    let mut parts = Vec::new();
    for entry in &PARAMETERS {
        let first = |section| Parameter::of_section(section).next() == Some(entry.parameter);
        if first(Section::Base) && scene.isolation == Directions::None {
            parts.push("no isolation".into());
        }
        if first(Section::Pulse)
            && let Some(pulse) = scene.excitation.other_pulse()
        {
            parts.push(pulse.into());
        }
        let Some(value) = single(entry) else { continue };
        match entry.parameter {
            Parameter::TMax => match scene.excitation {
                Excitation::Record(_) => parts.push("to the end of each record".into()),
                Excitation::Pulse(_) => parts.push(format!("{value} s simulated")),
            },
            // A block that begins upright is what is meant where nothing is said.
            Parameter::Tilt if value == 0.0 => {}
            _ => parts.push(entry.written(value)),
        }
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
