//! A horizontal and a vertical component of one place and time, which are brought together.

use super::component::Component;
use super::hints::RecordHints;
use super::lines::MOST_SAMPLES;
use super::read::COLUMNS;
use super::unlikely::unlikely;
use super::{
    ACCEPTED, DIGITS, GRAVITY, Pair, Provenance, Record, RecordFile, SceneError, Treatment, Units,
    Written, rounded,
};

/// Peak below which units that were given by hand are questioned, g: maps are requested of stronger motions.
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
    let is_vertical = |record: &Record| record.stated.component.map(Component::is_vertical);
    let h = &horizontal.title;
    if is_vertical(horizontal) == Some(true) {
        return asked("horizontal", format!("'{h}' is a vertical component"));
    }
    if let Some(what) = unlikely(&horizontal.samples) {
        return asked("horizontal", format!("{what}: '{h}' is no motion"));
    }
    if let Some(vertical) = vertical {
        let v = &vertical.title;
        let rests = vertical.peak() == 0.0;
        if let (Some(what), false) = (unlikely(&vertical.samples), rests) {
            return asked("vertical", format!("{what}: '{v}' is no motion"));
        }
        let is_same = vertical.samples == horizontal.samples;
        let channels = &vertical.stated.channels;
        let clear = |(_, component): &(String, Option<Component>)| {
            component.is_some_and(Component::is_vertical)
        };
        if (is_same || is_vertical(vertical) == Some(false))
            && vertical.stated.channel.is_none()
            && channels.len() > 1
            && !channels.iter().any(clear)
        {
            let problem = format!(
                "no channel of '{v}' is clearly vertical; give `vertical_channel`, a number from 1 on or a direction"
            );
            return asked("vertical", problem);
        }
        if is_same {
            return asked("vertical", "the same motion as the horizontal one".into());
        }
        if is_vertical(vertical) == Some(false) {
            return asked("vertical", format!("'{v}' is a horizontal component"));
        }
        if let Some(how) = vertical.stated.apart(&horizontal.stated) {
            return asked(
                "vertical",
                format!("'{v}' is of another place or time than '{h}': {how}"),
            );
        }
        let later = later(horizontal, vertical).abs();
        if later > horizontal.duration().min(vertical.duration()) {
            let later = rounded(later, 7);
            return asked("vertical", format!("'{v}' begins {later} s away from '{h}'"));
        }
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

/// By how much the vertical begins later than the horizontal, s, by what their files state; 0 where one states nothing,
/// and where one alone is a file of plain numbers, whose times are from no date.
pub(super) fn later(horizontal: &Record, vertical: &Record) -> f64 {
    let [one, other] = [horizontal, vertical].map(|record| record.stated.format == COLUMNS);
    match (horizontal.stated.start, vertical.stated.start) {
        (Some(h), Some(v)) if one == other => v - h,
        _ => 0.0,
    }
}

/// Puts zeros before the component that begins later, so many as there are whole steps between.
pub(super) fn align(horizontal: &mut Record, vertical: &mut Record) {
    let later_by = later(horizontal, vertical);
    let shorter = horizontal.duration().min(vertical.duration());
    let shifted = if later_by > 0.0 { vertical } else { horizontal };
    let steps = (later_by.abs() / shifted.dt).round();
    // Where it is forced, a component of another time is laid beside the other from the beginning.
    if steps < 1.0
        || later_by.abs() > shorter
        || steps + shifted.samples.len() as f64 > MOST_SAMPLES as f64
    {
        return;
    }
    let by = rounded(steps * shifted.dt, DIGITS);
    shifted.samples.splice(0..0, std::iter::repeat_n(0.0, steps as usize));
    shifted.stated.start = shifted.stated.start.map(|start| start - by);
    shifted.notes.push(format!(
        "begins {} s after the other component by its file: {by} s of zeros put before it",
        rounded(later_by.abs(), 7)
    ));
}

/// The motion of two components, as [`join`] makes it, of records that came from no file.
///
/// # Errors
/// Those of [`join`].
pub fn bring(
    mut horizontal: Record,
    mut vertical: Option<Record>,
    hints: &RecordHints,
    force: bool,
) -> Result<Pair, SceneError> {
    if let (Some(fault), false) = (questioned(&horizontal, vertical.as_ref(), hints), force) {
        return Err(fault);
    }
    if let Some(vertical) = &mut vertical {
        if vertical.stated.component == Some(Component::Down) {
            vertical.samples.iter_mut().for_each(|a| *a = -*a);
            vertical.notes.push("positive down by its file: turned over".into());
        }
        if vertical.peak() == 0.0 {
            vertical.notes.push("all zeros: the ground does not move vertically".into());
        }
        align(&mut horizontal, vertical);
    }
    let key = if vertical.is_some() { "vertical" } else { "horizontal" };
    Pair::new(horizontal, vertical).map_err(|error| SceneError::new(key, error.to_string()))
}

/// The motion of two components; `hints` is what was said of their files. A vertical that is positive down by its
/// file is turned over, and a component that begins later is moved to its time. `force` accepts what is improbable.
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
    let (vertical, vertical_file) = vertical.unzip();
    let mut pair = bring(horizontal, vertical, hints, force)?;
    let (horizontal, vertical) = (horizontal_file, vertical_file);
    let (dt, units) = (hints.dt, hints.units);
    pair.provenance = Some(Box::new(Provenance {
        horizontal,
        vertical,
        dt,
        units,
        horizontal_2: None,
        join: None,
        join_vertical: None,
        treatment: Treatment::default(),
    }));
    Ok(pair)
}
