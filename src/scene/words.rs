//! What a scene is, in words: for captions, and for what a command says.

use super::parameters::{Caption, Entry, PARAMETERS};
use super::{Directions, GRAVITY, Overturn, Parameter, Scene};

/// The parameters of a scene that its axes do not show, without its record's.
pub fn fixed(scene: &Scene) -> Vec<String> {
    let single = |parameter: Parameter| scene.numbers.get(parameter)?.single();
    let mut parts = Vec::new();
    let shown = |when| PARAMETERS.iter().filter(move |entry| entry.caption == when);
    for entry in shown(Caption::Always) {
        if entry.parameter == Parameter::TH {
            match scene.isolation {
                Directions::Dual => {}
                Directions::Horizontal => parts.push("horizontal isolation alone".into()),
                Directions::Vertical => parts.push("vertical isolation alone".into()),
                Directions::None => parts.push("no isolation".into()),
            }
        }
        if entry.parameter == Parameter::Omega
            && let Some(pulse) = scene.excitation.other_pulse()
        {
            parts.push(pulse.into());
        }
        parts.extend(single(entry.parameter).map(|value| entry.written(value)));
    }
    parts.extend(seldom_shown(scene, false));
    if scene.overturn == Overturn::QuarterTurn {
        parts.push("overturned at 90°".into());
    }
    parts
}

/// The parameters that captions leave out, because they have their usual values.
pub fn usual(scene: &Scene) -> Vec<String> {
    seldom_shown(scene, true)
}

/// The parameters that captions show where their values are unusual: those with the usual value, or the others.
fn seldom_shown(scene: &Scene, usual: bool) -> Vec<String> {
    let entries = PARAMETERS.iter().filter(|entry| entry.caption == Caption::Unusual);
    let value = |entry: &Entry| scene.numbers.get(entry.parameter)?.single();
    let of =
        |entry: &Entry| value(entry).filter(|value| (entry.default.parse() == Ok(*value)) == usual);
    entries.filter_map(|entry| Some(entry.written(of(entry)?))).collect()
}

/// The whole width and height of the block, where neither varies: B is half of the width, and H the height of the centre of
/// mass, which is half of that of a uniform block.
pub fn size(scene: &Scene) -> Option<String> {
    let twice = |parameter: Parameter| Some(2.0 * scene.numbers.get(parameter)?.single()?);
    let (width, height) = (twice(Parameter::HalfWidth)?, twice(Parameter::Height)?);
    Some(format!("{width} m wide; {height} m high if it is uniform"))
}

/// The parameters of a scene that its axes do not show.
pub fn parameters(scene: &Scene) -> Vec<String> {
    let mut parts = fixed(scene);
    let scaled = [Parameter::Scale, Parameter::Pga].map(|parameter| scene.numbers.get(parameter));
    let varies = scaled.into_iter().flatten().any(|values| values.count() > 1);
    if let Some(pair) = scene.excitation.record() {
        if !varies {
            parts.push(format!("PGA {:.3} g horizontal", pair.pga_h / GRAVITY));
        }
        if pair.pga_v == 0.0 {
            parts.push("no vertical motion".into());
        } else if !varies {
            parts.push(format!("{:.3} g vertical", pair.pga_v / GRAVITY));
        }
    }
    parts
}

/// The same in one line.
pub fn line(scene: &Scene) -> String {
    parameters(scene).join(", ")
}
