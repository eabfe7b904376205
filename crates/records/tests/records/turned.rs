//! A record turned to an azimuth.

use topple_records::turned::turned;
use topple_records::{Record, Stated, Treatment};

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
