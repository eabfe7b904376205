//! What a scene is, in words: for captions, and for what a command says.

use super::grid::Axis;
use super::parameters::{Caption, Entry, PARAMETERS};
use super::{Directions, GRAVITY, Overturn, Parameter, Scene, Values};

/// Most values of a list that are named.
const NAMED: usize = 8;

/// The values of an axis: `T_h = 1, 5 s`, or `T_h = 0.5 to 4 s, 400 values`.
pub fn axis(axis: &Axis) -> String {
    values(&axis.values, |numbers| axis.entry().written(numbers))
}

/// Values in words; `written` puts a symbol before the numbers and a unit behind them.
pub fn values(values: &Values, written: impl Fn(&str) -> String) -> String {
    let count = values.count();
    match values {
        Values::Range(range) if count > 1 => {
            let ends = written(&format!("{} to {}", range.start, range.stop));
            let log = if range.log { ", logarithmic" } else { "" };
            format!("{ends}, {count} values{log}")
        }
        values if count > NAMED => {
            let named: Vec<String> = values.iter().take(NAMED).map(|one| one.to_string()).collect();
            let ends = written(&format!("{}, ... {}", named.join(", "), values.last()));
            format!("{ends}, {count} values")
        }
        values => {
            let named: Vec<String> = values.iter().map(|one| one.to_string()).collect();
            written(&named.join(", "))
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::axis;
    use crate::scene::Parameter;
    use crate::scene::grid::Axis;

    #[test]
    fn an_axis_has_its_values_and_its_unit() {
        for (values, said) in [
            ("1,5", "T_h = 1, 5 s"),
            ("0.5:4:400", "T_h = 0.5 to 4 s, 400 values"),
            ("0.5:4:400:log", "T_h = 0.5 to 4 s, 400 values, logarithmic"),
            ("9,8,7,6,5,4,3,2,1", "T_h = 9, 8, 7, 6, 5, 4, 3, 2, ... 1 s, 9 values"),
        ] {
            let values = values.parse().unwrap();
            assert_eq!(axis(&Axis { parameter: Parameter::TH, values }), said);
        }
        let values = "-0.1,0.1".parse().unwrap();
        assert_eq!(axis(&Axis { parameter: Parameter::Eccentricity, values }), "ε = -0.1, 0.1");
    }
}
