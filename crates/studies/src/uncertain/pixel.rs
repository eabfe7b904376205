//! Values anywhere in the pixels of an axis: a map shows one value for all of them.

use topple::scene::parameters::Legal;
use topple::scene::{Grid, Parameter, Range, Scene, SceneError, Values};

/// The values of an axis, each moved to the same share of its own pixel: at 0 the low end, at 1 the high end. A pixel
/// of a range reaches half a step to both sides, in the logarithm where its steps are factors. A pixel of a list
/// reaches half the way to the values beside it in size, and at the ends of the list as far out as it does inwards.
pub fn moved(values: &Values, share: f64) -> Values {
    let steps = share - 0.5;
    match values {
        Values::Range(range) if range.count < 2 => values.clone(),
        Values::Range(range) if range.log => {
            let along = steps / f64::from(range.count - 1);
            // Of values below zero the larger is the one nearer to it.
            let along = along * (range.stop - range.start).signum();
            let factor = (range.stop / range.start).powf(along);
            Values::Range(Range {
                start: range.start * factor,
                stop: range.stop * factor,
                ..*range
            })
        }
        Values::Range(range) => {
            let by = steps * (range.stop - range.start).abs() / f64::from(range.count - 1);
            Values::Range(Range { start: range.start + by, stop: range.stop + by, ..*range })
        }
        Values::List(list) => {
            let mut sorted = list.clone();
            sorted.sort_by(f64::total_cmp);
            let within = |value: &f64| {
                let at = sorted.partition_point(|other| other < value);
                let below = at.checked_sub(1).map(|at| 0.5 * (sorted[at] + value));
                let above = sorted.get(at + 1).map(|next| 0.5 * (value + next));
                let (low, high) = match (below, above) {
                    (Some(low), Some(high)) => (low, high),
                    (Some(low), None) => (low, 2.0 * value - low),
                    (None, Some(high)) => (2.0 * value - high, high),
                    (None, None) => (*value, *value),
                };
                low + share * (high - low)
            };
            Values::List(list.iter().map(within).collect())
        }
    }
}

/// The axes of a scene that have pixels.
///
/// # Errors
/// No axis of several values, whole numbers, and pixels that reach out of what a number may be.
pub fn axes(scene: &Scene) -> Result<Vec<(Parameter, Values)>, SceneError> {
    let refused = |problem: String| Err(SceneError::new("pixel", problem));
    let mut axes = Vec::new();
    for axis in Grid::of(scene).axes().iter().filter(|axis| axis.count() > 1) {
        let entry = axis.entry();
        if let Legal::Whole(..) = entry.legal {
            return refused(format!(
                "{} is a whole number and has no pixels; leave one out",
                entry.key
            ));
        }
        let ((low, high), _) = entry.legal.ends();
        for share in [0.0, 1.0] {
            let (least, most) = moved(&axis.values, share).ends();
            let beyond =
                if least < low { Some(least) } else { Some(most).filter(|most| *most > high) };
            if let Some(value) = beyond {
                return refused(format!(
                    "a pixel of {} reaches {value}, which must {}; end the axis half a step earlier",
                    entry.key, entry.legal
                ));
            }
        }
        axes.push((axis.parameter, axis.values.clone()));
    }
    match axes.is_empty() {
        true => refused("no number has several values; give one a range, start:stop:count".into()),
        false => Ok(axes),
    }
}
