//! A horizontal and a vertical component of one place and time, which are brought together.

use super::component::{self, Vertical};
use super::read::RecordHints;
use super::{Pair, Provenance, Record, RecordFile, Units};
use crate::scene::parameters::ACCEPTED;
use crate::scene::{GRAVITY, SceneError};
use crate::written::Written;

/// Peak below which units that were given by hand are questioned, g: maps are asked for of stronger motions.
const WEAK: f64 = 0.1;

/// Peak above which values that are said to be in g are questioned: few records have more.
const STRONG: f64 = 2.0;

/// What makes a pair of records improbable.
fn questioned(
    horizontal: &Record,
    vertical: Option<&Record>,
    hints: &RecordHints,
) -> Option<SceneError> {
    let asked = |key, problem: String| Some(SceneError::new(key, format!("{problem}; {ACCEPTED}")));
    let (h, v) = (&horizontal.title, vertical.map_or("", |record| &record.title));
    if component::vertical(h).is_some() {
        return asked("horizontal", format!("'{h}' is a vertical component"));
    }
    if vertical.is_some_and(|vertical| vertical.samples == horizontal.samples) {
        return asked("vertical", "the same motion as the horizontal one".into());
    }
    if component::is_horizontal(v) {
        return asked("vertical", format!("'{v}' is a horizontal component"));
    }
    if component::apart(h, v) {
        return asked("vertical", format!("'{v}' is of another place or time than '{h}'"));
    }
    if let Some(units) = hints.units
        && units != Units::G
        && !hints.scaled
        && horizontal.peak() < WEAK * GRAVITY
    {
        let peak = horizontal.peak() / GRAVITY;
        let in_g = horizontal.peak() / units.factor();
        let problem = format!(
            "in {} the peak is {peak:.3} g, a weak motion; if the numbers are in g, it is {in_g:.2} g",
            units.key()
        );
        return asked("units", problem);
    }
    if hints.units == Some(Units::G) && !hints.scaled && horizontal.peak() > STRONG * GRAVITY {
        let peak = horizontal.peak() / GRAVITY;
        let problem = format!(
            "in g the peak is {peak:.2} g, as few records have; if the numbers are in m/s2, it is {:.2} g",
            peak / GRAVITY
        );
        return asked("units", problem);
    }
    None
}

/// The motion of two components; `hints` is what was said of their files. A vertical that is positive down by its
/// title is turned over. `force` accepts what is improbable.
///
/// # Errors
/// What makes the pair improbable: a vertical given as horizontal, two places, the same motion twice, units. Those of
/// [`Pair::new`].
pub fn join(
    (horizontal, horizontal_file): (Record, RecordFile),
    vertical: Option<(Record, RecordFile)>,
    hints: &RecordHints,
    force: bool,
) -> Result<Pair, SceneError> {
    let (mut vertical, vertical_file) = vertical.unzip();
    if let (Some(fault), false) = (questioned(&horizontal, vertical.as_ref(), hints), force) {
        return Err(fault);
    }
    if let Some(vertical) = &mut vertical
        && component::vertical(&vertical.title) == Some(Vertical::Down)
    {
        vertical.samples.iter_mut().for_each(|a| *a = -*a);
        vertical.notes.push("positive down by its title: turned over".into());
    }
    let key = if vertical.is_some() { "vertical" } else { "horizontal" };
    let pair = Pair::new(horizontal, vertical);
    let mut pair = pair.map_err(|error| SceneError::new(key, error.to_string()))?;
    let (horizontal, vertical) = (horizontal_file, vertical_file);
    let (dt, units) = (hints.dt, hints.units);
    pair.provenance = Some(Box::new(Provenance { horizontal, vertical, dt, units }));
    Ok(pair)
}
