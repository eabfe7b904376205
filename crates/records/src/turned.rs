//! A horizontal record turned to an azimuth: a(theta) = a_1 cos(theta - theta_1) + a_2 cos(theta - theta_2), of two
//! components at right angles.

use super::joined::{align, later};
use super::pair::common;
use super::steps::at;
use super::{ACCEPTED, Record, SceneError, Treatment, of_one, rounded};

/// By how much two components may miss a right angle, degrees: files state whole degrees.
const OFF: f64 = 1.0;

/// The record at an azimuth, of two components. `force` accepts components of two places.
pub fn turned(
    mut one: Record,
    mut other: Record,
    azimuth: f64,
    treatment: &Treatment,
    force: bool,
) -> Result<Record, SceneError> {
    let of = |key, record: &mut Record, given: Option<f64>| {
        if let (Some(given), Some(stated)) = (given, record.stated.azimuth)
            && given.rem_euclid(360.0) != stated
        {
            record
                .notes
                .push(format!("azimuth {given} degrees, as given; its file states {stated}"));
        }
        given.or(record.stated.azimuth).ok_or_else(|| {
            let problem = format!(
                "the file of '{}' does not tell its azimuth; give degrees from north over east",
                record.title
            );
            SceneError::new(key, problem)
        })
    };
    let first = of("horizontal_azimuth", &mut one, treatment.horizontal_azimuth)?;
    let second = of("horizontal_2_azimuth", &mut other, treatment.horizontal_2_azimuth)?;
    let refused = |problem: String| Err(SceneError::new("horizontal_2", problem));
    let between = (second - first).rem_euclid(180.0);
    if (between - 90.0).abs() > OFF {
        return refused(format!(
            "azimuths of {first} and {second} degrees are not at right angles; give the component at a right angle"
        ));
    }
    if one.samples == other.samples {
        return refused("the same motion as `horizontal`; give the other component".into());
    }
    if let (Some(how), false) = (other.stated.apart(&one.stated), force) {
        let title = &other.title;
        return refused(format!("'{title}' is of another place or time: {how}; {ACCEPTED}"));
    }
    if other.stated.component.is_some_and(|component| component.is_vertical()) {
        return refused(format!(
            "'{}' is a vertical component; give a horizontal one",
            other.title
        ));
    }
    let apart = later(&one, &other).abs();
    if apart > one.duration().min(other.duration()) && !force {
        return refused(format!(
            "'{}' begins {} s away from '{}'; {ACCEPTED}",
            other.title,
            rounded(apart, 7),
            one.title
        ));
    }
    align(&mut one, &mut other);
    let steps = common([&one, &other])
        .map_err(|error| SceneError::new("horizontal_2", error.to_string()))?;
    let count = steps.count([one.samples.len(), other.samples.len()]) as usize;
    let factors = [first, second].map(|own| (azimuth - own).to_radians().cos());
    let samples = (0..count).map(|k| {
        factors[0] * at(&one.samples, k, steps.parts[0])
            + factors[1] * at(&other.samples, k, steps.parts[1])
    });
    let (mut notes, mut doubts) = (one.notes, one.doubts);
    notes.extend(of_one("second component", &other.notes));
    doubts.extend(of_one("second component", &other.doubts));
    notes.push(format!(
        "turned to {azimuth} degrees, of '{}' at {first} and '{}' at {second} degrees",
        one.title, other.title
    ));
    Ok(Record {
        title: format!("{} turned to {azimuth} degrees", one.title),
        dt: steps.step(one.dt, Some(other.dt)),
        samples: samples.collect(),
        stated: one.stated,
        notes,
        doubts,
    })
}
