//! The motion of a floor: that of the ground, and of a linear oscillator on it. With u'' + 2 xi omega u' + omega^2 u = -a_g,
//! the floor's absolute acceleration is a_g + gamma u''; gamma = 1 is the oscillator's mass itself, another one the share of
//! the building's first mode at a height (its participation factor times its shape there).

use std::f64::consts::TAU;

use super::lines::MOST_SAMPLES;
use super::oscillator::Step;
use super::treatment::DAMPING;
use super::{DIGITS, Pair, Treatment, rounded};
use crate::scene::SceneError;

/// Samples of a floor's motion to its period at least: between them the motion is linear, and a sine's peak is missed by
/// 1 - cos(pi/20), a hundredth.
const SAMPLES: f64 = 20.0;
/// Most parts of a record's step.
const MOST_PARTS: f64 = 64.0;

impl Pair {
    /// The motion of a floor above this ground; the vertical one stays the ground's.
    ///
    /// # Errors
    /// A period that is far shorter than the time step; more samples than a record may have.
    pub(in crate::scene) fn floor(
        mut self,
        period: f64,
        treatment: &Treatment,
    ) -> Result<Pair, SceneError> {
        let damping = treatment.floor_damping.unwrap_or(DAMPING);
        let factor = treatment.floor_factor.unwrap_or(1.0);
        let parts = (SAMPLES * self.dt / period - 1.0e-9).ceil().max(1.0);
        let count = (self.len() - 1) as f64 * parts + 1.0;
        if parts > MOST_PARTS || count > MOST_SAMPLES as f64 {
            let problem = format!(
                "{period} s is too short for a record whose samples are {} s apart; give a longer period",
                self.dt
            );
            return Err(SceneError::new("floor_period", problem));
        }
        let parts_of_step = parts as usize;
        let dt = rounded(self.dt / parts, DIGITS);
        let omega = TAU / period;
        let step = Step::of(omega, damping, dt);
        let absolute = |ground: f64, u: f64, du: f64| {
            (1.0 - factor) * ground - factor * (2.0 * damping * omega * du + omega * omega * u)
        };
        let refined = |samples: &[f64]| -> Vec<f64> {
            (0..count as usize).map(|k| super::steps::at(samples, k, parts_of_step)).collect()
        };
        let ground = refined(&self.horizontal);
        let (mut u, mut du) = (0.0, 0.0);
        let mut floor = Vec::with_capacity(ground.len());
        floor.push(absolute(ground[0], u, du));
        for gap in ground.windows(2) {
            (u, du) = step.end(&step.motion(u, du, gap[0], gap[1]));
            floor.push(absolute(gap[1], u, du));
        }
        let below = self.pga_h;
        self.vertical = refined(&self.vertical).into();
        self.horizontal = floor.into();
        self.dt = dt;
        self.measure();
        let [from, to] = [below, self.pga_h].map(|peak| rounded(peak, 4));
        let finer = if parts > 1.0 { format!("; in steps of {dt} s") } else { String::new() };
        self.notes.push(format!(
            "a floor's motion: an oscillator of {period} s and damping {damping}, {factor} times its acceleration added to \
             the ground's; PGA {from} -> {to} m/s2; the vertical is the ground's{finer}"
        ));
        self.title = format!("{}, on a floor of {period} s", self.title);
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::record::Record;

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
}
