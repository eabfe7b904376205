//! From a point of the grid to the numbers that a backend runs on, and back to its outcome.

use std::f64::consts::TAU;

use bytemuck::Zeroable;

use super::plan::Plan;
use crate::model::block::{ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::scene::{Excitation, GRAVITY, Point};
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::stepping::state::{
    EVENT_LIMIT, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, PROVED, State, check_cell,
};

/// A landing block comes to rest when its next flight would last less than this share of a step.
pub const FLIGHTS_A_STEP: f64 = 32.0;

impl Plan {
    /// A cell's numbers and the state that it starts in: at rest, the base in static equilibrium.
    pub fn cell<R: Real>(&self, point: &Point) -> (Cell<R>, State<R>) {
        let clock = self.clock(point);
        let mut cell = Cell::<R>::zeroed();
        let phase_step = match &self.scene.excitation {
            Excitation::Pulse(_) => clock.step_forced * point.omega / TAU,
            Excitation::Record(_) => 1.0 / f64::from(clock.substeps),
        };
        cell.amplitude_h = R::of(point.a_h);
        cell.amplitude_v = R::of(point.a_v);
        cell.phase_step = R::of(phase_step);
        cell.substeps = clock.substeps;
        cell.step_forced = R::of(clock.step_forced);
        cell.step_free = R::of(clock.step_free);
        cell.steps_forced = clock.steps_forced;
        cell.steps = clock.steps;
        if let Some(base) = &self.scene.isolation.horizontal {
            let omega_h = TAU / point.t_h;
            // (21): u_y = alpha_y PGA_h / omega_h^2; PGA_h is |A_h| for a pulse.
            let yield_force = base.alpha_y * point.a_h.abs();
            cell.post_yield = R::of(base.psi * omega_h * omega_h);
            cell.hysteretic = R::of((1.0 - base.psi) * yield_force);
            cell.damping_h = R::of(2.0 * base.xi_h * omega_h);
            cell.reach_h =
                R::of(omega_h * (1.0 + 4.0 * base.xi_h * base.xi_h / self.free_share_h()).sqrt());
            let u_y = yield_force / (omega_h * omega_h);
            cell.yield_energy = R::of((1.0 - base.psi) * yield_force * u_y);
            // Without horizontal excitation u_y is zero, and so is the force that z carries.
            // So they may be taken to be where the number type does not hold 1/u_y.
            let inverse = R::of(omega_h * omega_h / yield_force);
            cell.inverse_yield = if inverse.to_f64().is_finite() { inverse } else { R::of(0.0) };
        }
        let mut state = State::<R>::zeroed();
        if let Some(base) = &self.scene.isolation.vertical {
            let omega_v = TAU / point.t_v;
            cell.stiffness_v = R::of(omega_v * omega_v);
            cell.damping_v = R::of(2.0 * base.xi_v * omega_v);
            cell.reach_v =
                R::of(omega_v * (1.0 + 4.0 * base.xi_v * base.xi_v / self.free_share_v()).sqrt());
            let deflection = GRAVITY / (omega_v * omega_v);
            cell.deflection = R::of(deflection);
            state.motion.v = R::of(-deflection);
            state.max_v = R::of(deflection);
        }
        let tilt = self.scene.tilt;
        state.motion.phi = R::of(tilt);
        if tilt > 0.0 {
            state.mode = ROCKING_LEFT;
        } else if tilt < 0.0 {
            state.mode = ROCKING_RIGHT;
        }
        // A flight at the speed w lasts 2 w M D / (M g b): the corner with the shorter arm is the
        // quicker to land.
        let b = self.scene.block.arm(1.0).max(self.scene.block.arm(-1.0));
        let fall = GRAVITY * b / self.impact_inertia(b);
        let step = clock.step_forced.max(clock.step_free);
        cell.rest_speed = R::of(0.5 * fall * step / FLIGHTS_A_STEP);
        state.min_contact = R::of(GRAVITY);
        check_cell(&cell, &mut state);
        (cell, state)
    }

    /// What became of a cell whose run has ended in `state`.
    pub fn outcome<R: Real>(&self, point: &Point, state: &State<R>) -> Outcome {
        let clock = self.clock(point);
        let block = &self.scene.block;
        let (left, right) = (state.max_phi_left.to_f64(), state.max_phi_right.to_f64());
        let stood = state.uplifts == 0 && self.scene.tilt == 0.0;
        let stands = if stood { Class::FullContact } else { Class::Rocking };
        let (mut class, mut status) = match state.status {
            FINISHED => (stands, Status::Ok),
            PROVED => (stands, Status::Proved),
            OVERTURNED_LEFT => (Class::OverturnedLeft, Status::Ok),
            OVERTURNED_RIGHT => (Class::OverturnedRight, Status::Ok),
            EVENT_LIMIT => (Class::Unresolved, Status::EventLimit),
            _ => (Class::Unresolved, Status::Diverged),
        };
        if !state.motion.reals().iter().all(|x| x.to_f64().is_finite()) {
            (class, status) = (Class::Unresolved, Status::Diverged);
        }
        let mut zeta = (left / block.critical_angle(1.0)).max(right / block.critical_angle(-1.0));
        if class.overturned() {
            zeta = 1.0;
        }
        let reached = clock.time(state.step, state.end_fraction.to_f64());
        Outcome {
            class,
            impacts: state.impacts,
            uplifts: state.uplifts,
            t_end: if matches!(state.status, FINISHED | PROVED) {
                self.scene.t_max
            } else {
                reached
            },
            t_simulated: if state.status == FINISHED { self.scene.t_max } else { reached },
            t_uplift: (state.uplifts > 0)
                .then(|| clock.time(state.uplift_step, state.uplift_fraction.to_f64())),
            zeta,
            max_phi_left: left,
            max_phi_right: right,
            max_u: state.max_u.to_f64(),
            max_v: state.max_v.to_f64(),
            min_contact: state.min_contact.to_f64(),
            friction: state.friction.to_f64(),
            status,
        }
    }
}
