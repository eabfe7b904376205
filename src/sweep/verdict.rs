//! What the reference's sample says of a map, in words.

use std::time::Duration;

use crate::scene::Grid;
use crate::stepping::outcome::Class;
use crate::sweep::verification::{Difference, Verdict, Verification, ZETA_OFF};

/// How the reference's sample came out, which had so much time.
pub fn agreement(v: &Verification, within: Duration) -> String {
    let left_out = match v.chosen - v.sampled {
        0 => String::new(),
        _ if within == Duration::MAX => {
            format!(" of {}, the reference gave the others up", v.chosen)
        }
        _ => format!(" of {}, as many as {} s allowed", v.chosen, within.as_secs()),
    };
    let unresolved = match v.unresolved {
        0 => String::new(),
        count => format!("{count} unresolved, "),
    };
    let within = [
        v.worst_t_end.map(|worst| format!("t_end within {} s", rounded(worst))),
        v.worst_zeta.map(|worst| format!("zeta within {}", rounded(worst))),
    ];
    let within: Vec<String> = within.into_iter().flatten().collect();
    let within = if within.is_empty() { String::new() } else { format!("; {}", within.join(", ")) };
    format!(
        "{} again{left_out}, {} beside a boundary: {unresolved}{} differ in outcome, {} overturned cells in \
         impacts{within}",
        cells(v.sampled),
        v.beside_boundary,
        v.differ,
        v.impacts_differ
    )
}

/// A small number to one digit: `2e-7`, `0`.
fn rounded(number: f64) -> String {
    if number == 0.0 { "0".into() } else { format!("{number:.0e}") }
}

/// So many cells that differ.
fn differ(count: usize) -> String {
    if count == 1 { "1 cell differs".into() } else { format!("{count} cells differ") }
}

/// So many cells.
pub fn cells(count: usize) -> String {
    if count == 1 { "1 cell".into() } else { format!("{count} cells") }
}

/// Cells that differ which are told.
const SHOWN: usize = 3;

/// The first cells whose outcome differs, a line each: where they lie, and both outcomes.
pub fn differences(v: &Verification, grid: &Grid) -> Vec<String> {
    let place = |at: &[f64]| {
        let axes = grid.axes().iter().zip(at);
        let parts: Vec<String> =
            axes.map(|(axis, value)| axis.parameter.entry().written(value)).collect();
        parts.join(", ")
    };
    let line = |difference: &Difference| {
        let Difference { at, sweep, reference, .. } = difference;
        format!("at {}: {}, by the reference {}", place(at), said(*sweep), said(*reference))
    };
    let mut lines: Vec<String> = v.differences.iter().take(SHOWN).map(line).collect();
    if v.differ > SHOWN {
        lines.push(format!("and {} more; run.json lists the first", v.differ - SHOWN));
    }
    lines
}

/// An outcome in words.
fn said(class: Class) -> String {
    class.name().replace('_', " ")
}

/// What follows from the sample for a map, in a sentence.
pub fn told(v: &Verification) -> String {
    let places = [
        (v.differ_tensile, "where the contact force is tensile (hatched)"),
        (v.differ_beside_boundary, "beside a boundary"),
        (v.differ_sensitive, "in chaotic rocking, where a millionth of the block's width decides"),
        (v.differ_inside(), "inside an area of one outcome"),
    ];
    let places: Vec<String> = places
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, place)| format!("{count} {place}"))
        .collect();
    let places = places.join(", ");
    let [worst, median] = [v.worst_zeta, v.median_zeta].map(Option::unwrap_or_default);
    match v.verdict {
        Verdict::Right if worst > ZETA_OFF => format!(
            "every outcome of the sample is right, but zeta of one cell at least is off by {worst:.0e}"
        ),
        Verdict::Right => "every outcome of the sample is right".into(),
        Verdict::AsExpected => {
            format!("the map is right as far as can be expected: {}, {places}", differ(v.differ))
        }
        Verdict::Wrong if v.differ == 0 => format!(
            "the map is not right: half of the rocking cells are off by {median:.0e} in zeta or more; \
             try a smaller --step or --precision f64"
        ),
        Verdict::Wrong => format!(
            "the map is not right: {}, {places}; try a smaller --step, --precision f64 or --resolve",
            differ(v.differ)
        ),
        Verdict::Nothing => {
            format!("nothing is verified; --verify {} takes the time that it needs", v.chosen)
        }
    }
}
