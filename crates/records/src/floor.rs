//! The motion of a floor: that of the ground, and of a linear oscillator on it. With u'' + 2 xi omega u' + omega^2 u = -a_g,
//! the floor's absolute acceleration is a_g + gamma u''; gamma = 1 is the oscillator's mass itself, another one the share of
//! the building's first mode at a height (its participation factor times its shape there).

use std::f64::consts::TAU;

use super::lines::MOST_SAMPLES;
use super::oscillator::Step;
use super::treatment::DAMPING;
use super::{DIGITS, Pair, SceneError, Treatment, rounded};

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
    pub fn floor(mut self, period: f64, treatment: &Treatment) -> Result<Pair, SceneError> {
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
