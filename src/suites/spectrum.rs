//! Response spectra: the exact solution between samples, where the ground's acceleration is linear (Nigam & Jennings
//! 1969, "Calculation of response spectra from strong-motion earthquake records").

use std::f64::consts::TAU;

use rayon::prelude::*;

/// Share of the critical damping.
pub const DAMPING: f64 = 0.05;

/// The pseudo-acceleration omega^2 max|u| of an oscillator, m/s^2, until the motion ends.
pub fn pseudo_acceleration(samples: &[f64], dt: f64, period: f64, damping: f64) -> f64 {
    let omega = TAU / period;
    // Steps of a twentieth of the period at most: between two the largest |u| is missed by 1 - cos(pi/20) at most.
    let parts = (20.0 * dt / period).ceil().max(1.0);
    let h = dt / parts;
    let step = Step::of(omega, damping, h);
    let (mut u, mut du, mut peak) = (0.0, 0.0, 0.0_f64);
    for gap in samples.windows(2) {
        let slope = (gap[1] - gap[0]) / parts;
        let mut from = gap[0];
        // A count of parts is small.
        for _ in 0..parts as u32 {
            (u, du) = step.advance(u, du, from, from + slope);
            from += slope;
            peak = peak.max(u.abs());
        }
    }
    omega * omega * peak
}

/// Sa at several periods, m/s^2.
pub fn spectrum(samples: &[f64], dt: f64, periods: &[f64]) -> Vec<f64> {
    periods.par_iter().map(|period| pseudo_acceleration(samples, dt, *period, DAMPING)).collect()
}

/// What takes an oscillator over a step of linear acceleration.
struct Step {
    /// exp(-xi omega h) times the sine and the cosine of the damped phase.
    sine: f64,
    cosine: f64,
    omega: f64,
    damping: f64,
    damped: f64,
    h: f64,
}

impl Step {
    fn of(omega: f64, damping: f64, h: f64) -> Step {
        let damped = omega * (1.0 - damping * damping).sqrt();
        let decay = (-damping * omega * h).exp();
        let (sine, cosine) = (damped * h).sin_cos();
        Step { sine: decay * sine, cosine: decay * cosine, omega, damping, damped, h }
    }

    /// u'' + 2 xi omega u' + omega^2 u = -a with a linear from `from` to `to`: the particular solution is linear
    /// too, the rest swings freely.
    fn advance(&self, u: f64, du: f64, from: f64, to: f64) -> (f64, f64) {
        let Step { sine, cosine, omega, damping, damped, h } = *self;
        let square = omega * omega;
        // u_p = p + q t.
        let slope = (to - from) / h;
        let q = -slope / square;
        let p = (-from - 2.0 * damping * omega * q) / square;
        let (x, dx) = (u - p, du - q);
        let rate = (dx + damping * omega * x) / damped;
        let swing = x * cosine + rate * sine;
        let dswing = -damping * omega * swing + damped * (rate * cosine - x * sine);
        (p + q * h + swing, q + dswing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under a constant acceleration a the oscillator swings about -a/omega^2, first to (1 + exp(-xi pi/sqrt(1 - xi^2)))
    /// times that.
    #[test]
    fn a_step_of_acceleration_has_its_closed_form() {
        let samples = vec![2.0; 4001];
        for period in [0.2, 1.0, 3.0] {
            for damping in [0.0_f64, 0.05, 0.5] {
                let overshoot =
                    (-damping * std::f64::consts::PI / (1.0 - damping * damping).sqrt()).exp();
                let exact = 2.0 * (1.0 + overshoot);
                let got = pseudo_acceleration(&samples, 0.005, period, damping);
                // The peak lies between steps of a 20th of the period at most, here a 40th.
                assert!((got - exact).abs() < 0.004 * exact, "{period} {damping}: {got} {exact}");
            }
        }
    }
}
