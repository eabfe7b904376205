//! The pulses as their authors print them, in seconds. Only the names are shared with [`crate::model::pulse`].

use std::f64::consts::{PI, TAU};

use crate::model::pulse::Shape;
use crate::scene::case;

/// A pulse as a function of time.
#[derive(Debug, Clone, Copy)]
pub struct Pulse {
    shape: Shape,
    omega: f64,
    cycles: f64,
    gamma: f64,
    nu: f64,
    /// The divisor of its formula, which makes its largest magnitude 1.
    peak: f64,
}

impl Pulse {
    /// The pulse of a cell.
    pub fn new(case: &case::Pulse) -> Pulse {
        let (shape, omega, cycles) = (case.shape, case.omega, case.cycles);
        let (gamma, nu) = (case.gamma, case.phase);
        let mut pulse = Pulse { shape, omega, cycles, gamma, nu, peak: 1.0 };
        pulse.peak = match shape {
            Shape::RickerAntisymmetric => {
                let s = (3.0 - 6.0_f64.sqrt()).sqrt();
                s * (3.0 - s * s) * (-0.5 * s * s).exp()
            }
            Shape::MavroeidisPapageorgiou => pulse.largest(),
            _ => 1.0,
        };
        pulse
    }

    /// The time of its end, s.
    pub fn end(&self) -> f64 {
        let period = TAU / self.omega;
        match self.shape {
            Shape::OneSine | Shape::OneCosine => self.cycles * period,
            Shape::HalfSine | Shape::Rectangle => PI / self.omega,
            Shape::Ricker => 3.0 * period,
            Shape::RickerAntisymmetric => 4.0 * period,
            Shape::MavroeidisPapageorgiou => self.gamma * period,
        }
    }

    /// The acceleration of the ground over the amplitude at a time, s.
    pub fn wave(&self, t: f64) -> f64 {
        let period = TAU / self.omega;
        // The time from the middle.
        let tau = t - 0.5 * self.end();
        let formula = match self.shape {
            Shape::OneSine | Shape::HalfSine => (self.omega * t).sin(),
            Shape::OneCosine => (self.omega * t).cos(),
            Shape::Rectangle => 1.0,
            Shape::Ricker => {
                // Vassiliou & Makris (2011).
                let square = (PI * tau / period).powi(2);
                (1.0 - 2.0 * square) * (-square).exp()
            }
            Shape::RickerAntisymmetric => {
                let square = 4.0 * (PI * tau / period).powi(2) / 3.0;
                (square - 3.0) * (TAU * tau / (3.0_f64.sqrt() * period)) * (-0.5 * square).exp()
            }
            Shape::MavroeidisPapageorgiou => self.velocity_rate(tau),
        };
        formula / self.peak
    }

    /// dv/dt of Mavroeidis & Papageorgiou (2003), by the product rule, over A Omega/(2 gamma).
    fn velocity_rate(&self, tau: f64) -> f64 {
        let (slow, fast) = (self.omega * tau / self.gamma, self.omega * tau + self.nu);
        -(slow.sin() * fast.cos() + self.gamma * fast.sin() * (1.0 + slow.cos()))
    }

    /// The largest magnitude, from samples and the parabola through the three around the largest.
    fn largest(&self) -> f64 {
        const SAMPLES_A_PERIOD: f64 = 2000.0;
        let half = 0.5 * self.end();
        let samples = (self.gamma * SAMPLES_A_PERIOD).ceil();
        let apart = 2.0 * half / samples;
        let mut largest = 0.0_f64;
        for sample in 0..=samples as u32 {
            let tau = f64::from(sample) * apart - half;
            let [before, now, after] =
                [-1.0, 0.0, 1.0].map(|side| self.velocity_rate(tau + side * apart).abs());
            largest = largest.max(now);
            let bend = 2.0 * now - before - after;
            if now > before && now > after {
                largest = largest.max(now + (after - before).powi(2) / (8.0 * bend));
            }
        }
        largest
    }
}
