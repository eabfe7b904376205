//! The motion of a floor has its closed form.

use std::f64::consts::TAU;

use topple_records::{Pair, Record, Treatment};

const DT: f64 = 0.002;

fn floor(samples: Vec<f64>, period: f64, damping: f64, factor: f64) -> Pair {
    let record = Record { dt: DT, samples, ..Record::default() };
    let treatment = Treatment {
        floor_damping: Some(damping),
        floor_factor: Some(factor),
        ..Treatment::default()
    };
    Pair::new(record, None).unwrap().floor(period, &treatment).unwrap()
}

/// Under sin(w t) a damped oscillator comes to |u''| = (w/omega)^2 / sqrt((1 - r^2)^2 + (2 xi r)^2), r = w/omega, and its
/// absolute acceleration to sqrt(1 + (2 xi r)^2) over the same root. What is left of the start is exp(-xi omega t), the
/// chords of the sine are off by (w dt)^2/12 at most.
#[test]
fn a_floor_under_a_harmonic_ground_has_its_closed_form() {
    let (period, damping) = (0.8, 0.1);
    let omega = TAU / period;
    for r in [0.3_f64, 1.0, 2.5] {
        let w = r * omega;
        let samples: Vec<f64> = (0..20_001).map(|k| (w * f64::from(k) * DT).sin()).collect();
        let root = ((1.0 - r * r).powi(2) + (2.0 * damping * r).powi(2)).sqrt();
        let steady = |pair: &Pair| {
            pair.horizontal[15_000..].iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
        };
        let mass = steady(&floor(samples.clone(), period, damping, 1.0));
        let wanted = (1.0 + (2.0 * damping * r).powi(2)).sqrt() / root;
        assert!((mass / wanted - 1.0).abs() < (w * DT).powi(2), "{r}: {mass} {wanted}");
        // a_g + 1.5 u'': the phasor 1 + 1.5 r^2 / (1 - r^2 + 2 i xi r).
        let (re, im) = (1.0 - r * r, 2.0 * damping * r);
        let (x, y) = (re + 1.5 * r * r, im);
        let higher = steady(&floor(samples.clone(), period, damping, 1.5));
        let wanted = (x * x + y * y).sqrt() / root;
        assert!((higher / wanted - 1.0).abs() < (w * DT).powi(2), "{r}: {higher} {wanted}");
    }
}

#[test]
fn a_floor_of_factor_0_is_the_ground_and_a_short_period_has_fine_steps() {
    let samples: Vec<f64> = (0..500).map(|k| (0.1 * f64::from(k)).sin()).collect();
    let ground = floor(samples.clone(), 0.5, 0.05, 0.0);
    assert_eq!(ground.horizontal[..], samples[..]);
    let short = floor(samples, 0.01, 0.05, 1.0);
    assert_eq!((short.dt, short.len(), short.vertical.len()), (0.0005, 1997, 1997));
}
