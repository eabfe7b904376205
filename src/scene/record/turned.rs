//! A horizontal record turned to an azimuth: a(theta) = a_1 cos(theta - theta_1) + a_2 cos(theta - theta_2), of two
//! components at right angles.

use super::joined::{align, later};
use super::pair::common;
use super::steps::at;
use super::{Record, Treatment, of_one, rounded};
use crate::scene::SceneError;
use crate::scene::parameters::ACCEPTED;

/// By how much two components may miss a right angle, degrees: files state whole degrees.
const OFF: f64 = 1.0;

/// The record at an azimuth, of two components. `force` accepts components of two places.
pub(in crate::scene) fn turned(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::record::Stated;

    fn record(samples: Vec<f64>, azimuth: Option<f64>) -> Record {
        let stated = Stated { azimuth, ..Stated::default() };
        Record { title: "r".into(), dt: 0.01, samples, stated, ..Record::default() }
    }

    /// The motion is a vector: its square stays, and at the azimuth of a component it is that.
    #[test]
    fn a_turned_record_is_a_component_of_the_same_vector() {
        let east: Vec<f64> = (0..50).map(|k| f64::from(k).sin()).collect();
        let north: Vec<f64> = (0..50).map(|k| (0.3 * f64::from(k)).cos()).collect();
        let at = |azimuth: f64| {
            let [n, e] = [record(north.clone(), Some(0.0)), record(east.clone(), Some(90.0))];
            turned(n, e, azimuth, &Treatment::default(), false).unwrap().samples
        };
        let (a, b) = (at(30.0), at(120.0));
        for k in 0..50 {
            let square = north[k] * north[k] + east[k] * east[k];
            assert!((a[k] * a[k] + b[k] * b[k] - square).abs() < 1e-14);
            // North-east is positive in both.
            assert!((at(45.0)[k] - (north[k] + east[k]) / 2.0_f64.sqrt()).abs() < 1e-14);
            assert!((at(90.0)[k] - east[k]).abs() < 1e-14, "{k}");
            assert!((at(180.0)[k] + north[k]).abs() < 1e-14, "{k}");
        }
    }

    #[test]
    fn azimuths_are_stated_or_given_and_at_right_angles() {
        let of = |one, other, treatment: Treatment| {
            let (a, b) = (record(vec![1.0, 2.0], one), record(vec![0.0, 1.0], other));
            turned(a, b, 0.0, &treatment, false)
        };
        let none = Treatment::default();
        let given = Treatment { horizontal_2_azimuth: Some(318.0), ..none };
        assert_eq!(of(Some(228.0), None, given).unwrap().notes.len(), 1);
        let over = of(Some(228.0), Some(90.0), given).unwrap().notes.join("\n");
        assert!(
            over.contains("component: azimuth 318 degrees, as given; its file states 90"),
            "{over}"
        );
        assert_eq!(of(Some(228.0), None, none).unwrap_err().key, "horizontal_2_azimuth");
        assert_eq!(of(None, Some(228.0), none).unwrap_err().key, "horizontal_azimuth");
        let askew = of(Some(10.0), Some(60.0), none).unwrap_err().to_string();
        assert!(askew.contains("10 and 60 degrees are not at right angles"), "{askew}");
    }
}
