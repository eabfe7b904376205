//! What the names of columns say that a column is: one of accelerations, of another quantity, in which unit.

use super::words::{
    TIMES, columns, dashes, in_brackets, is_length, is_unit, parts, says_acceleration,
    says_integral,
};
use super::{alarm, directions, polarity};
use crate::numbers::number;
use crate::{Component, Units};

/// The name of the one column of values in a line that names it, beside a column of times or alone with its units:
/// `Time (s), NS (g)`, `NS (g)`.
pub(super) fn lone_column(line: &str) -> Option<String> {
    let mut names = columns(line);
    let is_time = |name: &String| parts(name).first().is_some_and(|part| TIMES.contains(&&**part));
    let has_units = |name: &String| bracket(name).is_some_and(Units::are_meant);
    let is_one = match &names[..] {
        [time, _] => is_time(time),
        [name] => has_units(name),
        _ => false,
    };
    names.pop().filter(|_| is_one)
}

/// What stands in the last bracket of a name that may be a unit: `g` of `UD (g) (+)`.
pub(super) fn bracket(name: &str) -> Option<&str> {
    in_brackets(name).into_iter().rev().find(|text| !is_sign_or_direction(text))
}

/// True of what stands in a bracket and is no unit: `+`, `-1`, `positive down`, `UD`, `inverted`, `x1000`.
fn is_sign_or_direction(text: &str) -> bool {
    let states = || {
        polarity::in_brackets(text).is_some()
            || Component::named(text).is_some()
            || alarm::of_name(text, None)
    };
    let is_sign = || dashes(text).chars().all(|c| c.is_whitespace() || "+-/".contains(c));
    !is_unit(text) && (is_sign() || number(text).is_some() || states())
}

/// True of names of columns of which all but the times are velocities, displacements or spectra, by their words or by
/// their units.
pub(super) fn are_integrals(line: &str) -> bool {
    let names = columns(line);
    let measured = |name: &str| bracket(name).is_some_and(is_length);
    if let Some(name) = lone_column(line) {
        return says_integral(&name) || measured(&name);
    }
    if let [name] = &names[..] {
        // A word alone may be a place.
        let is_name = line.contains(['(', '[', '_']);
        let directed = || directions::of_column(name).is_some();
        return is_name && (says_integral(name) || measured(name) && directed());
    }
    let is_acceleration = names.iter().any(|name| says_acceleration(name));
    if !is_acceleration
        && names.iter().any(|name| says_integral(name))
        && names.iter().any(|name| measured(name))
    {
        return in_brackets(line).iter().all(|text| Units::named(text).is_none());
    }
    names.len() > 1
        && names.len() <= 12
        && names.iter().any(|name| says_integral(name))
        && names.iter().all(|name| says_integral(name) || TIMES.contains(&&*parts(name).join(" ")))
}

/// True of a column's name that is an acceleration's or a direction's, and nothing besides.
pub(super) fn is_channel(name: &str) -> bool {
    let other = says_integral(name) || TIMES.contains(&&*name.trim().to_lowercase());
    !other && (says_acceleration(name) || directions::of_column(name).is_some())
}
