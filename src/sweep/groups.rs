//! The numbers of a cell in groups, each by the parameters that it depends on. All are made in `f64`
//! and rounded once.

use std::f64::consts::TAU;

use bytemuck::Zeroable;

use super::clock::Clock;
use super::plan::Plan;
use crate::model::excitation::Cell;
use crate::model::real::{Real, pod};
use crate::scene::{Excitation, GRAVITY};

/// A landing block comes to rest when its next flight would last less than this share of a step.
pub const FLIGHTS_A_STEP: f64 = 32.0;

/// What the horizontal isolation adds to a cell, by T_h and A_h.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Horizontal<R> {
    /// See [`Cell::post_yield`].
    pub post_yield: R,
    /// See [`Cell::hysteretic`].
    pub hysteretic: R,
    /// See [`Cell::damping_h`].
    pub damping_h: R,
    /// See [`Cell::inverse_yield`].
    pub inverse_yield: R,
    /// See [`Cell::yield_energy`].
    pub yield_energy: R,
    /// See [`Cell::reach_h`].
    pub reach_h: R,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub sound: R,
}

/// What the vertical isolation adds to a cell, by T_v.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Vertical<R> {
    /// See [`Cell::stiffness_v`].
    pub stiffness_v: R,
    /// See [`Cell::damping_v`].
    pub damping_v: R,
    /// See [`Cell::deflection`].
    pub deflection: R,
    /// See [`Cell::reach_v`].
    pub reach_v: R,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub sound: R,
}

/// What the excitation adds to a cell, by A_h and A_v.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Drive<R> {
    /// See [`Cell::amplitude_h`].
    pub amplitude_h: R,
    /// See [`Cell::amplitude_v`].
    pub amplitude_v: R,
    /// A_h over that of the shared full contact, whose motion of u is proportional to it.
    pub scale: R,
    /// 1 where the amplitudes are finite, 0 where the number type does not hold one.
    pub sound: R,
}

/// A cell's steps, by its clock and Omega.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Steps<R> {
    /// See [`Cell::phase_step`].
    pub phase_step: R,
    /// See [`Cell::step_forced`].
    pub step_forced: R,
    /// See [`Cell::step_free`].
    pub step_free: R,
    /// See [`Cell::rest_speed`].
    pub rest_speed: R,
    /// See [`Cell::steps_forced`].
    pub steps_forced: u32,
    /// See [`Cell::steps`].
    pub steps: u32,
    /// See [`Cell::substeps`].
    pub substeps: u32,
    /// 1 where all these numbers are finite, 0 where the number type does not hold one.
    pub sound: u32,
}

pod!(Horizontal, reals: 7, words: 0);
pod!(Vertical, reals: 5, words: 0);
pod!(Drive, reals: 4, words: 0);
pod!(Steps, reals: 4, words: 4);

fn finite<R: Real, const N: usize>(numbers: [R; N]) -> bool {
    numbers.iter().all(|number| number.to_f64().is_finite())
}

fn flag<R: Real>(sound: bool) -> R {
    R::of(f64::from(u8::from(sound)))
}

impl Plan {
    /// The numbers of the horizontal isolation; zeros where it is locked.
    pub fn horizontal<R: Real>(&self, t_h: f64, a_h: f64) -> Horizontal<R> {
        let mut group = Horizontal::<R>::zeroed();
        if let Some(base) = &self.scene.isolation.horizontal {
            let omega_h = TAU / t_h;
            // (21): u_y = alpha_y PGA_h / omega_h^2; PGA_h is |A_h| for a pulse.
            let yield_force = base.alpha_y * a_h.abs();
            group.post_yield = R::of(base.psi * omega_h * omega_h);
            group.hysteretic = R::of((1.0 - base.psi) * yield_force);
            group.damping_h = R::of(2.0 * base.xi_h * omega_h);
            group.reach_h =
                R::of(omega_h * (1.0 + 4.0 * base.xi_h * base.xi_h / self.free_share_h()).sqrt());
            let u_y = yield_force / (omega_h * omega_h);
            group.yield_energy = R::of((1.0 - base.psi) * yield_force * u_y);
            // Without horizontal excitation u_y is zero, and so is the force that z carries.
            // So they may be taken to be where the number type does not hold 1/u_y.
            let inverse = R::of(omega_h * omega_h / yield_force);
            group.inverse_yield = if inverse.to_f64().is_finite() { inverse } else { R::of(0.0) };
        }
        let Horizontal { post_yield, hysteretic, damping_h, inverse_yield, .. } = group;
        let numbers = [post_yield, hysteretic, damping_h, inverse_yield];
        group.sound = flag(finite(numbers) && finite([group.yield_energy, group.reach_h]));
        group
    }

    /// The numbers of the vertical isolation; zeros where it is locked.
    pub fn vertical<R: Real>(&self, t_v: f64) -> Vertical<R> {
        let mut group = Vertical::<R>::zeroed();
        if let Some(base) = &self.scene.isolation.vertical {
            let omega_v = TAU / t_v;
            group.stiffness_v = R::of(omega_v * omega_v);
            group.damping_v = R::of(2.0 * base.xi_v * omega_v);
            group.deflection = R::of(GRAVITY / (omega_v * omega_v));
            group.reach_v =
                R::of(omega_v * (1.0 + 4.0 * base.xi_v * base.xi_v / self.free_share_v()).sqrt());
        }
        let Vertical { stiffness_v, damping_v, deflection, reach_v, .. } = group;
        group.sound = flag(finite([stiffness_v, damping_v, deflection, reach_v]));
        group
    }

    /// The numbers of the excitation; `shared` is the A_h of the shared full contact, where it has
    /// one.
    pub fn drive<R: Real>(&self, a_h: f64, a_v: f64, shared: Option<f64>) -> Drive<R> {
        let (amplitude_h, amplitude_v) = (R::of(a_h), R::of(a_v));
        let scale = R::of(shared.map_or(1.0, |amplitude| a_h / amplitude));
        Drive { amplitude_h, amplitude_v, scale, sound: flag(finite([amplitude_h, amplitude_v])) }
    }

    /// The numbers of a clock's steps; `fall` is that of `Plan::fall`.
    #[inline]
    pub fn steps<R: Real>(&self, omega: f64, clock: &Clock, fall: f64) -> Steps<R> {
        let phase_step = match &self.scene.excitation {
            Excitation::Pulse(_) => clock.step_forced * omega / TAU,
            Excitation::Record(_) => 1.0 / f64::from(clock.substeps),
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
            sound: u32::from(finite([phase_step, step_forced, step_free, rest_speed])),
        }
    }

    /// Rate at which a block that stands on a corner falls back, rad/s^2. A flight at the speed w
    /// lasts 2 w M D / (M g b): the corner with the shorter arm is the quicker to land.
    pub(super) fn fall(&self) -> f64 {
        let b = self.scene.block.arm(1.0).max(self.scene.block.arm(-1.0));
        GRAVITY * b / self.impact_inertia(b)
    }
}

/// The groups of one cell.
#[derive(Debug, Clone, Copy)]
pub struct Groups<R> {
    /// Of the horizontal isolation.
    pub horizontal: Horizontal<R>,
    /// Of the vertical isolation.
    pub vertical: Vertical<R>,
    /// Of the excitation.
    pub drive: Drive<R>,
    /// Of the clock.
    pub steps: Steps<R>,
}

impl<R: Real> Groups<R> {
    /// The cell of these numbers.
    #[inline(always)]
    pub fn cell(&self) -> Cell<R> {
        let Groups { horizontal, vertical, drive, steps } = self;
        Cell {
            post_yield: horizontal.post_yield,
            hysteretic: horizontal.hysteretic,
            damping_h: horizontal.damping_h,
            inverse_yield: horizontal.inverse_yield,
            stiffness_v: vertical.stiffness_v,
            damping_v: vertical.damping_v,
            amplitude_h: drive.amplitude_h,
            amplitude_v: drive.amplitude_v,
            phase_step: steps.phase_step,
            step_forced: steps.step_forced,
            step_free: steps.step_free,
            rest_speed: steps.rest_speed,
            yield_energy: horizontal.yield_energy,
            deflection: vertical.deflection,
            reach_h: horizontal.reach_h,
            reach_v: vertical.reach_v,
            steps_forced: steps.steps_forced,
            steps: steps.steps,
            substeps: steps.substeps,
            padding: 0,
        }
    }

    /// False where the number type does not hold one of the cell's numbers.
    #[inline(always)]
    pub fn sound(&self) -> bool {
        let Groups { horizontal, vertical, drive, steps } = self;
        let zero = R::of(0.0);
        horizontal.sound > zero && vertical.sound > zero && drive.sound > zero && steps.sound > 0
    }
}
