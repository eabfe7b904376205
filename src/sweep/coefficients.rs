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
            padding: R::of(0.0),
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
            padding_0: R::of(0.0),
            padding_1: R::of(0.0),
        }
    }

    /// The squares of the base's largest angular frequencies with the block rocking on it, which are
    /// larger than the base's own: a part for each direction, whose sum is the square about a corner.
    /// That of a stiff or locked base is no less than the block's own p^2.
    pub(super) fn swing_h(&self, t_h: f64) -> SwingH {
        let p2 = [1.0, -1.0].map(|side| self.most_p2(self.scene.block.arm(side)));
        let Some(law) = &self.scene.isolation.horizontal else {
            return SwingH { squares: p2, longest: f64::INFINITY };
        };
        let squares = [1.0, -1.0].map(|side| {
            let b = self.scene.block.arm(side);
            let (h2, b2) = (self.scene.block.height * self.scene.block.height, b * b);
            (TAU / t_h).powi(2) * (1.0 + self.mu_h * (h2 + b2) / self.swing_inertia(b))
        });
        let squares = [squares[0].max(p2[0]), squares[1].max(p2[1])];
        let longest = if self.has_hysteretic_variable() {
            let yield_time = law.alpha_y * t_h / (TAU * f64::from(law.n));
            self.resolution.longest_in_yield(yield_time)
        } else {
            f64::INFINITY
        };
        SwingH { squares, longest }
    }

    /// The vertical part of [`Plan::swing_h`].
    pub(super) fn swing_v(&self, t_v: f64) -> SwingV {
        if self.scene.isolation.vertical.is_none() {
            return SwingV { squares: [0.0; 2] };
        }
        let squares = [1.0, -1.0].map(|side| {
            let b = self.scene.block.arm(side);
            let (h2, b2) = (self.scene.block.height * self.scene.block.height, b * b);
            let q2 = match self.scene.overturn {
                Overturn::CriticalAngle => b2,
                Overturn::QuarterTurn => b2 + h2,
            };
            (TAU / t_v).powi(2) * (1.0 + self.mu_v * q2 / self.swing_inertia(b))
        });
        SwingV { squares }
    }

    /// p^2 = g R/(I/M) of a block about a corner, or what a light base makes of it at most, 1/s^2.
    fn most_p2(&self, b: f64) -> f64 {
        GRAVITY * b.hypot(self.scene.block.height) / self.swing_inertia(b)
    }

    /// No larger than I/M - mu_h P^2 - mu_v Q^2 about a corner in any position: P^2 and Q^2 at their
    /// largest, their sum fixed.
    fn swing_inertia(&self, b: f64) -> f64 {
        let block = &self.scene.block;
        let radius2 = block.height * block.height + b * b;
        let least = block.inertia / block.mass + radius2 * (1.0 - self.mu_h.max(self.mu_v));
        self.impact_inertia(b).min(least)
    }

    /// The excitation's part of a clock.
    pub(super) fn span(&self, omega: f64) -> Span {
        let (forced, longest) = match &self.scene.excitation {
            Excitation::Pulse(_) => {
                let pulse = TAU / omega;
                (pulse.min(self.scene.t_max), self.resolution.longest_in_pulse(pulse))
            }
            Excitation::Record(pair) => (pair.duration(), f64::INFINITY),
        };
        Span { omega, forced, longest }
    }

    /// The steps of a cell: the pulse's end is a step boundary.
    pub fn clock(&self, point: &Point) -> Clock {
        let span = self.span(point.omega);
        self.clock_of(&self.swing_h(point.t_h), &self.swing_v(point.t_v), &span)
    }

    /// The clock of its parts.
    #[inline]
    pub(super) fn clock_of(&self, h: &SwingH, v: &SwingV, span: &Span) -> Clock {
        let square = |corner: usize| h.squares[corner] + v.squares[corner];
        let square = square(0).max(square(1));
        // The longest step is bounded by the cell's fastest period, infinite where nothing
        // oscillates.
        let longest = self.resolution.longest_step(TAU / square.sqrt()).min(h.longest);
        let (steps_forced, substeps) = match &self.scene.excitation {
            Excitation::Pulse(_) => {
                ((span.forced / longest.min(span.longest)).ceil().max(1.0), 1.0)
            }
            Excitation::Record(pair) => {
                let substeps = (pair.dt / longest).ceil().max(1.0);
                (substeps * (pair.len() - 1) as f64, substeps)
            }
        };
        let free = self.scene.t_max - span.forced;
        // What rounding leaves of a duration is no step.
        let steps_free = (free / longest - 1.0e-9).ceil().max(0.0);
        Clock {
            step_forced: span.forced / steps_forced,
            step_free: if steps_free > 0.0 { free / steps_free } else { 0.0 },
            // `as` saturates; `Plan::new` refuses a scene that comes near.
            steps_forced: steps_forced as u32,
            substeps: substeps as u32,
            steps: (steps_forced + steps_free) as u32,
        }
    }
}

/// The horizontal isolation's part of a clock, by T_h.
#[derive(Debug, Clone, Copy)]
pub(super) struct SwingH {
    /// About the left and the right corner, 1/s^2.
    squares: [f64; 2],
    /// The longest step of a base that yields, s; infinite for one that does not.
    longest: f64,
}

/// The vertical isolation's part of a clock, by T_v.
#[derive(Debug, Clone, Copy)]
pub(super) struct SwingV {
    /// About the left and the right corner, 1/s^2.
    squares: [f64; 2],
}

/// The excitation's part of a clock, by Omega.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// rad/s; of no meaning for a record.
    pub(super) omega: f64,
    /// Duration of the excitation, s.
    forced: f64,
    /// The longest step of a pulse, s; infinite for a record.
    longest: f64,
}
