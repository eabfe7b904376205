//! Response spectra, by the exact motion of an oscillator.

use std::f64::consts::TAU;

use topple::scene::record::oscillator::{Motion, Step};
use topple::work::parallel;

/// Share of the critical damping.
pub const DAMPING: f64 = 0.05;

/// Share of the largest |u| by which what is found may be too small.
const TOLERANCE: f64 = 1.0e-6;
/// Halvings of a step: the last parts are a billionth of it, where |u| is even to rounding.
const HALVINGS: u32 = 30;

/// The pseudo-acceleration omega^2 max|u| of an oscillator, m/s^2, until the motion ends. At any time between samples u is
/// exact, and its largest value is found to a millionth.
pub fn pseudo_acceleration(samples: &[f64], dt: f64, period: f64, damping: f64) -> f64 {
    let omega = TAU / period;
    // Any step is exact. One of an eighth of the period bounds |u| within it by 0.08 of the swing's amplitude, so that few
    // steps are looked into.
    let parts = (8.0 * dt / period).ceil().max(1.0);
    let step = Step::of(omega, damping, dt / parts);
    let (mut u, mut du, mut peak) = (0.0, 0.0, 0.0_f64);
    for gap in samples.windows(2) {
        let slope = (gap[1] - gap[0]) / parts;
        let mut from = gap[0];
        // A count of parts is small.
        for _ in 0..parts as u32 {
            let motion = step.motion(u, du, from, from + slope);
            let before = u;
            (u, du) = step.end(&motion);
            from += slope;
            peak = peak.max(u.abs());
            peak = largest((&step, &motion), (0.0, before), (step.h, u), HALVINGS, peak);
        }
    }
    omega * omega * peak
}

/// Sa at several periods, m/s^2.
pub fn spectrum(samples: &[f64], dt: f64, periods: &[f64]) -> Vec<f64> {
    parallel::each(periods.len(), 1, |k| pseudo_acceleration(samples, dt, periods[k], DAMPING))
}

/// The largest |u| so far, after a part of the step between two times with their u. Within the part |u| is no more than
/// the larger of its ends and |u''| t^2/8: where this is not above the largest value so far by more than the tolerance
/// the part is left alone, else it is halved.
fn largest(
    (step, motion): (&Step, &Motion),
    from: (f64, f64),
    to: (f64, f64),
    left: u32,
    peak: f64,
) -> f64 {
    let length = to.0 - from.0;
    let most = from.1.abs().max(to.1.abs()) + 0.125 * length * length * motion.bend;
    // Not by the other comparison: one that is no number ends it, too.
    if !(most > peak * (1.0 + TOLERANCE)) || left == 0 {
        return peak;
    }
    let t = 0.5 * (from.0 + to.0);
    let middle = (t, step.at(motion, t));
    let peak = peak.max(middle.1.abs());
    let peak = largest((step, motion), from, middle, left - 1, peak);
    largest((step, motion), middle, to, left - 1, peak)
}
