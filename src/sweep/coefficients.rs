//! The numbers that all cells of a plan share, and each cell's steps.

use std::f64::consts::TAU;

use super::bounds::Lever;
use super::clock::Clock;
use super::plan::Plan;
use crate::model::block::{Corner, Model};
use crate::model::real::Real;
use crate::scene::{Excitation, GRAVITY, Overturn, Point};

impl Plan {
    /// rho^2 + H^2 kappa_h + b^2 kappa_v, D of (18) over M M_t M_v, for lever arm `b`.
    pub(super) fn impact_inertia(&self, b: f64) -> f64 {
        let block = &self.scene.block;
        let rho2 = block.inertia / block.mass;
        let height2 = block.height * block.height;
        rho2 + height2 * (1.0 - self.mu_h) + b * b * (1.0 - self.mu_v)
    }

    /// One corner; `side` is +1 for the left, -1 for the right.
    fn corner<R: Real>(&self, side: f64) -> Corner<R> {
        let block = &self.scene.block;
        let rho2 = block.inertia / block.mass;
        let (h, b, c) = (block.height, block.arm(side), block.arm(-side));
        let width = 2.0 * block.half_width;
        let (kappa_h, kappa_v) = (1.0 - self.mu_h, 1.0 - self.mu_v);
        let d = self.impact_inertia(b);
        let mut eta_phi = (rho2 + h * h * kappa_h - b * c * kappa_v) / d;
        if let Some(restitution) = self.scene.restitution {
            eta_phi = restitution;
        }
        Corner {
            side: R::of(side),
            arm: R::of(b),
            inertia: R::of(rho2 + b * b + h * h),
            overturn: R::of(self.scene.overturning_angle(side)),
            eta_phi: R::of(eta_phi),
            eta_u: R::of(width * b * h * self.mu_h * kappa_v / d),
            eta_v: R::of(width * self.mu_v * (h * h * kappa_h + rho2) / d),
        }
    }

    /// What all cells share.
    pub fn model<R: Real>(&self) -> Model<R> {
        let block = &self.scene.block;
        let radius = |side: f64| f64::hypot(block.arm(side), block.height);
        let inverse = |mu: f64| R::of(if mu > 0.0 { 1.0 / mu } else { 0.0 });
        Model {
            left: self.corner(1.0),
            right: self.corner(-1.0),
            height: R::of(block.height),
            mu_h: R::of(self.mu_h),
            mu_v: R::of(self.mu_v),
            gravity: R::of(GRAVITY),
            inverse_mu_h: inverse(self.mu_h),
            inverse_mu_v: inverse(self.mu_v),
            least_arm: R::of(block.arm(1.0).min(block.arm(-1.0))),
            topple_energy: R::of(GRAVITY * (radius(1.0).min(radius(-1.0)) - block.height)),
            impact_gain: R::of(self.impact_gain()),
            normal_share: R::of(self.normal_share()),
            normal_by_shear: R::of((1.0 - self.mu_v) * self.most_pq()),
            normal_by_turn: R::of((1.0 - self.mu_v) * self.most_by_turn(Lever::Height)),
            shear_by_normal: R::of((1.0 - self.mu_h) * self.most_pq()),
            shear_by_turn: R::of((1.0 - self.mu_h) * self.most_by_turn(Lever::Arm)),
        }
    }

    /// The cell's longest step, s: bounded by its fastest period, that of the base with the block
    /// rocking on it, which is shorter than the base's own.
    fn longest_step(&self, point: &Point) -> f64 {
        let block = &self.scene.block;
        let mut square: f64 = 0.0;
        for side in [1.0, -1.0] {
            let b = block.arm(side);
            let (h2, b2) = (block.height * block.height, b * b);
            // Larger than in any position: P^2 and Q^2 at their largest, their sum fixed.
            let d = self.impact_inertia(b).min(self.least_inertia(b));
            let q2 = match self.scene.overturn {
                Overturn::CriticalAngle => b2,
                Overturn::QuarterTurn => b2 + h2,
            };
            let mut sum = 0.0;
            if self.scene.isolation.horizontal.is_some() {
                sum += (TAU / point.t_h).powi(2) * (1.0 + self.mu_h * (h2 + b2) / d);
            }
            if self.scene.isolation.vertical.is_some() {
                sum += (TAU / point.t_v).powi(2) * (1.0 + self.mu_v * q2 / d);
            }
            square = square.max(sum);
        }
        // Infinite where nothing oscillates.
        let longest = self.resolution.longest_step(TAU / square.sqrt());
        match &self.scene.isolation.horizontal {
            Some(law) if law.psi < 1.0 => {
                let yield_time = law.alpha_y * point.t_h / (TAU * f64::from(law.n));
                longest.min(self.resolution.longest_in_yield(yield_time))
            }
            _ => longest,
        }
    }

    /// The least that I/M - mu_h P^2 - mu_v Q^2 can be about a corner.
    fn least_inertia(&self, b: f64) -> f64 {
        let block = &self.scene.block;
        let radius2 = block.height * block.height + b * b;
        block.inertia / block.mass + radius2 * (1.0 - self.mu_h.max(self.mu_v))
    }

    /// The steps of a cell: the pulse's end is a step boundary.
    pub fn clock(&self, point: &Point) -> Clock {
        let longest = self.longest_step(point);
        let (forced, steps_forced, substeps) = match &self.scene.excitation {
            Excitation::Pulse(_) => {
                let pulse = TAU / point.omega;
                let forced = pulse.min(self.scene.t_max);
                let steps =
                    (forced / longest.min(self.resolution.longest_in_pulse(pulse))).ceil().max(1.0);
                (forced, steps, 1.0)
            }
            Excitation::Record(pair) => {
                let substeps = (pair.dt / longest).ceil().max(1.0);
                (pair.duration(), substeps * (pair.len() - 1) as f64, substeps)
            }
        };
        let free = self.scene.t_max - forced;
        // What rounding leaves of a duration is no step.
        let steps_free = (free / longest - 1.0e-9).ceil().max(0.0);
        Clock {
            step_forced: forced / steps_forced,
            step_free: if steps_free > 0.0 { free / steps_free } else { 0.0 },
            // `as` saturates; `Plan::new` refuses a scene that comes near.
            steps_forced: steps_forced as u32,
            substeps: substeps as u32,
            steps: (steps_forced + steps_free) as u32,
        }
    }
}
