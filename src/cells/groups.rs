//! The numbers of a cell in groups, each by the parameters that it depends on. All are computed in `f64`
//! and rounded once.

use std::f64::consts::TAU;

use bytemuck::Zeroable;

use super::body::Body;
use super::clock::Clock;
use crate::model::excitation::{Cell, Drive, Horizontal, Steps, Vertical};
use crate::model::pulse::Modulation;
use crate::model::real::Real;
use crate::scene::case::PEAK;
use crate::scene::{Case, Directions, Parameter, Pulse, Shaking};

/// A landing block comes to rest when its next flight would last less than a step divided by this number.
pub const FLIGHTS_A_STEP: f64 = 32.0;

fn finite<R: Real, const N: usize>(numbers: [R; N]) -> bool {
    numbers.iter().all(|number| number.to_f64().is_finite())
}

fn flag<R: Real>(finite: bool) -> R {
    R::of(f64::from(u8::from(finite)))
}

impl<R: Real> Horizontal<R> {
    /// The parameters that it depends on, with those of the [body](super::body::body_parameters).
    pub fn law() -> Vec<Parameter> {
        Parameter::of_direction(Directions::Horizontal).chain(PEAK).collect()
    }

    /// The numbers of a cell; zeros where the direction is locked.
    pub fn of(case: &Case, body: &Body) -> Horizontal<R> {
        let mut group = Horizontal::<R>::zeroed();
        if let Some(base) = &case.isolation.horizontal {
            let omega_h = TAU / base.t_h;
            // The largest force that z transmits, over M_t and (1 - psi).
            let yield_force = base.u_y * omega_h * omega_h;
            group.post_yield = R::of(base.psi * omega_h * omega_h);
            group.hysteretic = R::of((1.0 - base.psi) * yield_force);
            group.damping_h = R::of(2.0 * base.xi_h * omega_h);
            group.reach_h =
                R::of(omega_h * (1.0 + 4.0 * base.xi_h * base.xi_h / body.free_share_h()).sqrt());
            group.yield_energy = R::of((1.0 - base.psi) * yield_force * base.u_y);
            // Without a horizontal excitation u_y of (21) is zero, and so is the force that z transmits. Where the
            // number type cannot hold 1/u_y, both are taken as zero.
            let inverse = R::of(1.0 / base.u_y);
            group.inverse_yield = if inverse.to_f64().is_finite() { inverse } else { R::of(0.0) };
        }
        if let Some(stop) = &case.isolation.stop {
            group.stop_gap = R::of(stop.gap);
            group.stop_stiffness = R::of(stop.stiffness);
            group.stop_damping = R::of(stop.damping);
            group.stop_rate = R::of(body.stop_rate(stop));
        }
        let stop = [group.stop_gap, group.stop_stiffness, group.stop_damping, group.stop_rate];
        let Horizontal { post_yield, hysteretic, damping_h, inverse_yield, .. } = group;
        let numbers = [post_yield, hysteretic, damping_h, inverse_yield];
        group.finite =
            flag(finite(numbers) && finite([group.yield_energy, group.reach_h]) && finite(stop));
        group
    }
}

impl<R: Real> Vertical<R> {
    /// The parameters that it depends on, with those of the [body](super::body::body_parameters).
    pub fn law() -> Vec<Parameter> {
        Parameter::of_direction(Directions::Vertical).collect()
    }

    /// The numbers of a cell; zeros where the direction is locked.
    pub fn of(case: &Case, body: &Body) -> Vertical<R> {
        let mut group = Vertical::<R>::zeroed();
        if let Some(base) = &case.isolation.vertical {
            let omega_v = TAU / base.t_v;
            group.stiffness_v = R::of(omega_v * omega_v);
            group.damping_v = R::of(2.0 * base.xi_v * omega_v);
            group.deflection = R::of(base.deflection());
            group.reach_v =
                R::of(omega_v * (1.0 + 4.0 * base.xi_v * base.xi_v / body.free_share_v()).sqrt());
            let hardening = base.hardening.map_or(0.0, |v_c| omega_v * omega_v / (v_c * v_c));
            group.hardening_v = R::of(hardening);
        }
        let Vertical { stiffness_v, damping_v, deflection, reach_v, hardening_v, .. } = group;
        group.finite = flag(finite([stiffness_v, damping_v, deflection, reach_v, hardening_v]));
        group
    }
}

impl<R: Real> Drive<R> {
    /// The parameters that it depends on.
    pub const LAW: [Parameter; 7] = [
        Parameter::AH,
        Parameter::AV,
        Parameter::Gamma,
        Parameter::Phase,
        Parameter::Scale,
        Parameter::Pga,
        Parameter::Tilt,
    ];

    /// The numbers of a cell; `shared` is the A_h of the shared full contact, where it has one.
    pub fn of(case: &Case, shared: Option<f64>) -> Drive<R> {
        let none = Modulation { envelope: 0.0, carrier: 0.0 };
        let (a_h, a_v, peak, modulation) = match case.shaking {
            Shaking::Pulse(pulse) => {
                let Pulse { shape, gamma, phase, a_h, a_v, .. } = pulse;
                let modulated = shape.is_modulated();
                let modulation = if modulated { Modulation::of(gamma, phase) } else { none };
                (a_h, a_v, shape.peak(gamma, phase), modulation)
            }
            Shaking::Record { factor, .. } => (factor, factor, 1.0, none),
        };
        let (amplitude_h, amplitude_v) = (R::of(a_h / peak), R::of(a_v / peak));
        let (scale, tilt) =
            (R::of(shared.map_or(1.0, |amplitude| a_h / amplitude)), R::of(case.tilt));
        let (envelope, carrier) = (R::of(modulation.envelope), R::of(modulation.carrier));
        let finite = flag(finite([amplitude_h, amplitude_v, tilt]));
        Drive { amplitude_h, amplitude_v, scale, tilt, envelope, carrier, finite }
    }
}

impl<R: Real> Steps<R> {
    /// The lengths and numbers of the steps of a clock under a pulse of this Omega, or under a record; the block
    /// falls back at the rate `fall`.
    #[inline]
    pub fn of(omega: Option<f64>, clock: &Clock, fall: f64) -> Steps<R> {
        let phase_step = match omega {
            Some(omega) => clock.step_forced * omega / TAU,
            None => 1.0 / f64::from(clock.substeps),
        };
        let step = clock.step_forced.max(clock.step_free);
        let numbers = [phase_step, clock.step_forced, clock.step_free];
        let [phase_step, step_forced, step_free] = numbers.map(R::of);
        let rest_speed = R::of(0.5 * fall * step / FLIGHTS_A_STEP);
        Steps {
            phase_step,
            step_forced,
            step_free,
            rest_speed,
            steps_forced: clock.steps_forced,
            steps: clock.steps,
            substeps: clock.substeps,
            finite: u32::from(finite([phase_step, step_forced, step_free, rest_speed])),
        }
    }
}

impl<R: Real> Cell<R> {
    /// False where the number type cannot hold one of its numbers.
    #[inline(always)]
    pub fn finite(&self) -> bool {
        let Cell { horizontal, vertical, drive, steps, .. } = self;
        let zero = R::of(0.0);
        horizontal.finite > zero
            && vertical.finite > zero
            && drive.finite > zero
            && steps.finite > 0
    }
}
