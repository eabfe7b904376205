//! The outcome of a cell from its last state.

use super::clock::Clock;
use crate::model::asked::Asked;
use crate::model::real::Real;
use crate::scene::{Case, Parameter};
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::stepping::state::{
    EVENT_LIMIT, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, PROVED, State,
};

/// The numbers of a cell that its outcome needs beside the last state.
#[derive(Debug, Clone, Copy)]
pub struct Reader {
    t_max: f64,
    tilted: bool,
    /// alpha about the left and the right corner, rad.
    critical: [f64; 2],
    /// The static deflection, m.
    deflection: f64,
    /// M and M_t, kg.
    masses: [f64; 2],
    /// What was looked for.
    asked: Asked,
}

impl Reader {
    /// The parameters that it depends on, with those of the [body](super::body::body_parameters).
    pub const LAW: [Parameter; 4] =
        [Parameter::TMax, Parameter::Tilt, Parameter::TV, Parameter::StaticDeflection];

    /// That of a cell of a plan which looks for what is asked.
    pub fn of(case: &Case, asked: Asked) -> Reader {
        let critical = [1.0, -1.0].map(|side| case.block.critical_angle(side));
        let deflection = case.deflection();
        let mass = case.block.mass;
        let masses = [mass, mass + case.isolation.plate_h + case.isolation.plate_v];
        Reader { t_max: case.t_max, tilted: case.tilt != 0.0, critical, deflection, masses, asked }
    }

    /// The outcome of a cell of this clock whose last state is `state`; what was not looked for is not a number.
    #[inline]
    pub fn outcome<R: Real>(&self, clock: &Clock, state: &State<R>) -> Outcome {
        let extremes = &state.extremes;
        let (left, right) = (extremes.max_phi_left.to_f64(), extremes.max_phi_right.to_f64());
        let stood = state.uplifts == 0 && !self.tilted;
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
        let mut zeta = (left / self.critical[0]).max(right / self.critical[1]);
        if class.overturned() {
            zeta = 1.0;
        }
        let (least_v, most_v) = (extremes.least_v.to_f64(), extremes.most_v.to_f64());
        let max_v = (least_v - self.deflection).abs().max((most_v - self.deflection).abs());
        let reached = clock.time(state.step, state.end_fraction.to_f64());
        let ended = matches!(state.status, FINISHED | PROVED);
        let Asked { angles, displacements, forces, accelerations, stops } = self.asked;
        let known = |looked_for: bool, value: f64| if looked_for { value } else { f64::NAN };
        // As many digits as the number type has.
        let rounded = |value: f64| R::of(value).to_f64();
        let [mass, carried] = self.masses;
        Outcome {
            class,
            impacts: state.impacts,
            uplifts: state.uplifts,
            t_end: if ended { self.t_max } else { reached },
            t_simulated: if state.status == FINISHED { self.t_max } else { reached },
            t_uplift: (state.uplifts > 0)
                .then(|| clock.time(state.uplift_step, state.uplift_fraction.to_f64())),
            zeta: known(angles, zeta),
            max_phi_left: known(angles, left),
            max_phi_right: known(angles, right),
            max_u: known(displacements, extremes.max_u.to_f64()),
            max_v: known(displacements, rounded(max_v)),
            stroke_v: known(displacements, most_v.max(-least_v)),
            min_contact: known(forces, extremes.min_contact.to_f64()),
            friction: known(forces, extremes.friction.to_f64()),
            status,
            acc_plate: known(accelerations, extremes.acc_plate.to_f64()),
            acc_block: known(accelerations, extremes.acc_block.to_f64()),
            acc_plate_total: known(accelerations, extremes.acc_plate_total.to_f64()),
            acc_block_total: known(accelerations, extremes.acc_block_total.to_f64()),
            base_load: known(accelerations, rounded(mass * extremes.base_load.to_f64())),
            stop_force: known(stops, rounded(carried * extremes.stop_force.to_f64())),
            // A whole number, far below 2^32.
            stop_hits: extremes.stop_hits.to_f64() as u32,
        }
    }
}
