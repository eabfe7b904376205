//! The devices of a base in masses and forces: a slider under pressure, an end stop, a spring that hardens.
//!
//! Nothing here is shared with [`crate::model`]: forces are in newtons, and the force that presses on the slider is
//! part of the system of equations.

use super::system::{DU, DV, State, System, U, V, Z};
use crate::scene::GRAVITY;

impl System {
    /// The force of the spring and the hysteresis of the base, over the weight that rests on the base.
    pub(super) fn slope(&self, y: &State) -> f64 {
        let weight = (self.mass + self.plate_h + self.plate_v) * GRAVITY;
        (self.psi * self.k_h * y[U] + self.k_h * self.u_y * (1.0 - self.psi) * y[Z]) / weight
    }

    /// The force of the end stop on the base, N.
    pub(super) fn stop_push(&self, y: &State) -> f64 {
        let Some(stop) = self.stop.filter(|_| self.against != 0.0) else { return 0.0 };
        let (depth, speed) = (self.against * y[U] - stop.gap, self.against * y[DU]);
        -self.against * (stop.stiffness * depth + stop.damping * speed)
    }

    /// The side on which a base is against its end stop, +1 or -1, or zero. It is against the stop if it is beyond
    /// the gap and the stop pushes.
    pub(super) fn side_of_stop(&self, y: &State) -> f64 {
        if self.beyond_stop(y) > 0.0 { y[U].signum() } else { 0.0 }
    }

    /// Positive where the base is beyond the gap of its stop and the stop pushes, N; negative without a stop.
    pub(super) fn beyond_stop(&self, y: &State) -> f64 {
        let Some(stop) = self.stop else { return f64::NEG_INFINITY };
        let (depth, speed) = (y[U].abs() - stop.gap, y[U].signum() * y[DU]);
        let spring = stop.stiffness * depth;
        spring.min(spring + stop.damping * speed)
    }

    /// The force of the vertical spring and damper on the mass that they carry, N.
    pub(super) fn spring_v(&self, y: &State) -> f64 {
        let Some(deflection) = self.deflection else {
            return -(self.k_v * y[V] + self.c_v * y[DV]);
        };
        let carried = (self.mass + self.plate_v) * GRAVITY;
        let from_rest = y[V] + deflection;
        let harder = self.hardening.map_or(0.0, |v_c| self.k_v * from_rest.powi(3) / (v_c * v_c));
        carried - self.k_v * from_rest - harder - self.c_v * y[DV]
    }

    /// The energy of the vertical spring less the work of the weight, J, measured from the position where it is zero.
    pub(super) fn stored_v(&self, y: &State) -> f64 {
        let Some(deflection) = self.deflection else {
            return GRAVITY * (self.mass + self.plate_v) * y[V] + 0.5 * self.k_v * y[V] * y[V];
        };
        let from_rest = y[V] + deflection;
        let ratio = self.hardening.map_or(0.0, |v_c| from_rest / v_c);
        0.5 * self.k_v * from_rest * from_rest * (1.0 + 0.5 * ratio * ratio)
    }

    /// The energy that the end stop stores, J.
    pub(super) fn stored_stop(&self, y: &State) -> f64 {
        self.stop
            .map_or(0.0, |stop| 0.5 * stop.stiffness * (y[U].abs() - stop.gap).max(0.0).powi(2))
    }
}
