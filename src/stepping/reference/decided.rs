//! The time from which on the outcome and zeta of a cell do not change.
//!
//! Once nothing shakes the ground the mechanical energy does not rise: the base takes energy out, and so does an
//! impact by (15). The energy above rest is the sum of the kinetic energy, of what the springs store, and of M g times
//! the rise of the centre of mass, and none of these is negative. So the block turns no farther than to the angle at
//! which M g times the rise is the energy that is left.

use super::system::{Phase, Pole, State, System};
use crate::scene::GRAVITY;

/// The share of an energy by which this bound must hold: far more than the integration and rounding err by.
const MARGIN: f64 = 1.0e-6;

impl System {
    /// The largest |phi| over the critical angle, by the largest |phi| about the left and about the right corner.
    pub(super) fn zeta(&self, [left, right]: [f64; 2]) -> f64 {
        (left / self.critical_angle(Pole::Left)).max(right / self.critical_angle(Pole::Right))
    }

    /// True where the energy of a state, from which on nothing shakes the ground, does not suffice for a larger zeta.
    pub(super) fn is_decided(&self, phase: Phase, y: &State, zeta: f64) -> bool {
        // A slider whose force follows the pressure can bring energy in, and so can an impact whose restitution is given.
        let passive = !self.pressed && self.restitution.is_none() && self.restitution_factor <= 1.0;
        // Beyond the critical angle the centre of mass falls.
        if !passive || zeta <= 0.0 || zeta > 1.0 {
            return false;
        }
        let rise = |pole: Pole| {
            let (sin, cos) = (zeta * self.critical_angle(pole)).sin_cos();
            self.arm(pole) * sin + self.height * (cos - 1.0)
        };
        let least = rise(Pole::Left).min(rise(Pole::Right));
        let left = self.energy(phase, y) - self.energy(None, &self.at_rest());
        left * (1.0 + MARGIN) < self.mass * GRAVITY * least
    }
}
