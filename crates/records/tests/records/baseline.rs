//! The velocity that a record ends with, and a line taken away.

use std::f64::consts::TAU;

use topple_records::{Baseline, Record};

fn record(sample: impl Fn(f64) -> f64) -> Record {
    let samples = (0..=2000).map(|k| sample(0.01 * f64::from(k))).collect();
    Record { dt: 0.01, samples, ..Record::default() }
}

/// A motion whose velocity ends at 0: sin^2 (TAU t/20) sin(TAU t) over 20 s has no integral.
fn clean(t: f64) -> f64 {
    3.0 * (TAU * t / 40.0).sin().powi(2) * (TAU * t).sin()
}

#[test]
fn a_ground_that_ends_with_a_velocity_is_said_and_a_clean_one_is_not() {
    let clean_one = record(clean).on_baseline(None);
    assert!(clean_one.doubts.is_empty() && clean_one.notes.is_empty());
    // 0.3 m/s2 over 20 s are 6 m/s.
    let off = record(|t| clean(t) + 0.3).on_baseline(None);
    assert!(off.doubts[0].starts_with("the ground ends with the velocity 6 m/s, "), "{off:?}");
    // The peak velocity is about 1 m/s; an offset of a share of it over 20 s ends with that share.
    let peak = record(clean).end_and_peak().1;
    for (share, doubts) in [(0.2, 0), (0.5, 1)] {
        let off = record(|t| clean(t) + share * peak / 20.0).on_baseline(None);
        assert_eq!(off.doubts.len(), doubts, "{share}");
    }
}

/// The velocity of a constant is a line: nothing of it is left, and of a motion with one only the constant goes.
#[test]
fn a_line_takes_an_offset_away_and_says_by_how_much() {
    let alone = record(|_| 0.3).on_baseline(Some(Baseline::Line));
    assert!(alone.samples.iter().all(|sample| sample.abs() < 1e-14));
    let (off, plain) = (record(|t| clean(t) + 0.3), record(clean));
    let [off, plain] = [off, plain].map(|record| record.on_baseline(Some(Baseline::Line)));
    for (one, other) in off.samples.iter().zip(&plain.samples) {
        assert!((one - other).abs() < 1e-12);
    }
    assert!(off.doubts.is_empty());
    assert!(off.notes[0].contains("the velocity at the end was 6 m/s and is"), "{off:?}");
    // A step half way is no line: it is said after it, too.
    let step = |t: f64| clean(t) + if t < 18.0 { 0.0 } else { 3.0 };
    let step = record(step).on_baseline(Some(Baseline::Line));
    assert!(step.doubts[0].contains("even without a line of it"), "{step:?}");
    // None is what nothing is.
    let (none, nothing) = (record(clean).on_baseline(Some(Baseline::None)), record(clean));
    assert_eq!(none.samples, nothing.samples);
}
