//! Random records: sums of sines under envelopes.

use std::f64::consts::TAU;

use topple::scene::GRAVITY;
use topple::scene::record::{Pair, Record};

use super::scenes::{Dice, short};

/// One component: up to eight sines, each in an envelope of its own; some begin with a jump.
fn component(dice: &mut Dice, dt: f64, count: usize, peak: f64) -> Vec<f64> {
    let duration = dt * (count - 1) as f64;
    let jumps = dice.chance(0.25);
    let sines: Vec<[f64; 5]> = (0..dice.one_of(&[2, 4, 8]))
        .map(|_| {
            let frequency = dice.over(0.3, (0.2 / dt).min(15.0));
            let (middle, width) = (dice.within(0.1, 0.9), dice.within(0.1, 0.5));
            [
                frequency,
                dice.within(0.0, 1.0),
                dice.within(0.2, 1.0),
                middle * duration,
                width * duration,
            ]
        })
        .collect();
    let mut samples: Vec<f64> = (0..count)
        .map(|k| {
            let t = k as f64 * dt;
            // Without a jump the motion begins and ends at nothing.
            let ramp = (t.min(duration - t) / (0.05 * duration)).min(1.0);
            let sum: f64 = sines
                .iter()
                .map(|[frequency, phase, size, middle, width]| {
                    let envelope = (-((t - middle) / width).powi(2)).exp();
                    size * envelope * (TAU * (frequency * t + phase)).sin()
                })
                .sum();
            sum * if jumps { 1.0 } else { ramp }
        })
        .collect();
    let most = samples.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    samples.iter_mut().for_each(|a| *a *= peak / most);
    samples
}

/// A pair for a block that a push of `least_push` m/s^2 lifts.
pub fn pair(dice: &mut Dice, least_push: f64) -> Pair {
    let dt = dice.one_of(&[0.001, 0.002, 0.005, 0.005, 0.01, 0.01, 0.02]);
    let duration = dice.over(1.5, 12.0);
    let count = ((duration / dt) as usize).clamp(20, 4000);
    let record = |title: &str, samples: Vec<f64>| Record {
        title: title.into(),
        dt,
        samples,
        ..Record::default()
    };
    let peak = short(least_push * dice.over(0.7, 8.0));
    let horizontal = record("random", component(dice, dt, count, peak));
    let vertical = dice.chance(0.6).then(|| {
        let peak = GRAVITY * dice.over(0.05, 1.3);
        record("random, vertical", component(dice, dt, count, peak))
    });
    Pair::new(horizontal, vertical).unwrap()
}
