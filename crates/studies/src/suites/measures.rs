//! Intensity measures of a motion.

use std::f64::consts::PI;

use super::spectrum;
use topple::scene::GRAVITY;
use topple::scene::record::Pair;

/// Measures of a motion's strength. SI units; a record is linear between its samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Largest horizontal acceleration, m/s^2.
    pub pga_h: f64,
    /// Largest vertical acceleration, m/s^2.
    pub pga_v: f64,
    /// Largest horizontal velocity, m/s.
    pub pgv: f64,
    /// Arias intensity of the horizontal component, pi/(2 g) times the integral of a^2, m/s.
    pub arias: f64,
    /// Cumulative absolute velocity of the horizontal component, the integral of |a|, m/s.
    pub cav: f64,
    /// Time between 5 % and 75 % of the Arias intensity, s.
    pub d5_75: f64,
    /// Time between 5 % and 95 % of it, s.
    pub d5_95: f64,
}

impl Measures {
    /// Those of a motion.
    pub fn of(pair: &Pair) -> Measures {
        let a = &*pair.horizontal;
        let square = cumulative(a, pair.dt, |from, to| (from * from + from * to + to * to) / 3.0);
        let [t5, t75, t95] = [0.05, 0.75, 0.95].map(|share| reached(a, &square, pair.dt, share));
        Measures {
            pga_h: pair.pga_h,
            pga_v: pair.pga_v,
            pgv: peak_velocity(a, pair.dt),
            arias: PI / (2.0 * GRAVITY) * square.last().copied().unwrap_or(0.0),
            cav: cumulative(a, pair.dt, mean_magnitude).last().copied().unwrap_or(0.0),
            d5_75: t75 - t5,
            d5_95: t95 - t5,
        }
    }

    /// Sa(T) of a motion at 5 % of damping, m/s^2: the pseudo-acceleration.
    pub fn sa(pair: &Pair, period: f64) -> f64 {
        spectrum::pseudo_acceleration(&pair.horizontal, pair.dt, period, spectrum::DAMPING)
    }

    /// The geometric mean of Sa at ten periods from 0.2 T to 3 T, evenly apart (Eads, Miranda & Lignos 2015).
    pub fn average_sa(pair: &Pair, period: f64) -> f64 {
        const PERIODS: u32 = 10;
        let at = |k: u32| period * (0.2 + 2.8 * f64::from(k) / f64::from(PERIODS - 1));
        let logarithms = (0..PERIODS).map(|k| Measures::sa(pair, at(k)).ln());
        (logarithms.sum::<f64>() / f64::from(PERIODS)).exp()
    }
}

/// The integral up to each sample, from the mean over a gap between two.
fn cumulative(samples: &[f64], dt: f64, mean: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let mut sum = 0.0;
    let gaps = samples.windows(2).map(|gap| {
        sum += dt * mean(gap[0], gap[1]);
        sum
    });
    std::iter::once(0.0).chain(gaps).collect()
}

/// The mean of |a| over a gap, in which a may change its sign.
fn mean_magnitude(from: f64, to: f64) -> f64 {
    if from * to >= 0.0 {
        return 0.5 * (from.abs() + to.abs());
    }
    0.5 * (from * from + to * to) / (from - to).abs()
}

/// The largest velocity: at a sample, or where the acceleration passes zero between two.
fn peak_velocity(samples: &[f64], dt: f64) -> f64 {
    let (mut velocity, mut peak) = (0.0_f64, 0.0_f64);
    for gap in samples.windows(2) {
        let (from, to) = (gap[0], gap[1]);
        if from * to < 0.0 {
            let crest = velocity + 0.5 * dt * from * from / (from - to);
            peak = peak.max(crest.abs());
        }
        velocity += 0.5 * dt * (from + to);
        peak = peak.max(velocity.abs());
    }
    peak
}

/// When the integral of a^2, whose values at the samples are `square`, reaches a share of its last value, s.
fn reached(samples: &[f64], square: &[f64], dt: f64, share: f64) -> f64 {
    let wanted = share * square.last().copied().unwrap_or(0.0);
    let after = square.partition_point(|value| *value < wanted);
    if after == 0 || after >= square.len() {
        return 0.0;
    }
    let (from, to) = (samples[after - 1], samples[after]);
    let missing = wanted - square[after - 1];
    // Of a = from + slope t the integral is ((from + slope t)^3 - from^3)/(3 slope).
    let slope = (to - from) / dt;
    let within = match (to - from).abs() <= 1.0e-9 * from.abs().max(to.abs()) {
        true => missing / (from * from),
        false => ((from.powi(3) + 3.0 * slope * missing).cbrt() - from) / slope,
    };
    dt * (after - 1) as f64 + within.clamp(0.0, dt)
}
