//! A block on its base: the numbers that depend on the block, the masses and the restitution alone.

use crate::scene::isolation::Stop;
use crate::scene::parameters::Section;
use crate::scene::{Block, Case, GRAVITY, Overturn, Parameter};

/// The parameters that a body depends on: the numbers of the block of a scene, and the restitution.
pub fn body_parameters() -> Vec<Parameter> {
    let impact = [Parameter::Restitution, Parameter::RestitutionFactor];
    Parameter::of_section(Section::Block).chain(impact).collect()
}

/// A block on its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// The block.
    pub block: Block,
    /// mu_h = M/(M + m_h + m_v); zero where the horizontal direction is locked.
    pub mu_h: f64,
    /// mu_v = M/(M + m_v); zero where the vertical direction is locked.
    pub mu_v: f64,
    /// eta_phi in place of the law of impact.
    pub restitution: Option<f64>,
    /// r, the factor on the eta_phi of the law of impact.
    pub restitution_factor: f64,
    /// When the block counts as overturned.
    pub overturn: Overturn,
}

impl Body {
    /// The body of a cell.
    pub fn of(case: &Case) -> Body {
        let [mu_h, mu_v] = case.isolation.shares(&case.block);
        Body {
            block: case.block,
            mu_h,
            mu_v,
            restitution: case.restitution,
            restitution_factor: case.restitution_factor,
            overturn: case.overturn,
        }
    }

    /// rho^2 + H^2 kappa_h + b^2 kappa_v, D of (18) over M M_t M_v, for lever arm `b`.
    pub(crate) fn impact_inertia(&self, b: f64) -> f64 {
        let block = &self.block;
        let rho2 = block.inertia / block.mass;
        let height2 = block.height * block.height;
        rho2 + height2 * (1.0 - self.mu_h) + b * b * (1.0 - self.mu_v)
    }

    /// Rate at which a block that stands on a corner falls back, rad/s^2. A flight of initial speed w lasts 2 w M
    /// D/(M g b), so that the block lands sooner on the corner with the shorter arm.
    pub(crate) fn fall(&self) -> f64 {
        let b = self.block.arm(1.0).max(self.block.arm(-1.0));
        GRAVITY * b / self.impact_inertia(b)
    }

    /// The square of the largest angular frequency of the base while the block rocks on it about the left and about
    /// the right corner, over omega_h^2: it is larger than 1.
    pub(crate) fn stiffening_h(&self) -> [f64; 2] {
        self.arms().map(|b| {
            let (h2, b2) = (self.block.height * self.block.height, b * b);
            1.0 + self.mu_h * (h2 + b2) / self.swing_inertia(b)
        })
    }

    /// An upper bound on the rate of a motion against an end stop, 1/s: that of its spring under the block that
    /// rocks, and that of its damper.
    pub(crate) fn stop_rate(&self, stop: &Stop) -> f64 {
        let [left, right] = self.stiffening_h();
        let stiffening = left.max(right);
        (stop.stiffness * stiffening).sqrt().max(stop.damping * stiffening)
    }

    /// The same for omega_v.
    pub(crate) fn stiffening_v(&self) -> [f64; 2] {
        self.arms().map(|b| {
            let (h2, b2) = (self.block.height * self.block.height, b * b);
            let q2 = match self.overturn {
                Overturn::CriticalAngle => b2,
                Overturn::QuarterTurn => b2 + h2,
            };
            1.0 + self.mu_v * q2 / self.swing_inertia(b)
        })
    }

    /// p^2 = g R/(I/M) about the left and about the right corner, or the largest value that a light base can make of
    /// it, 1/s^2.
    pub(crate) fn most_p2(&self) -> [f64; 2] {
        self.arms().map(|b| GRAVITY * b.hypot(self.block.height) / self.swing_inertia(b))
    }

    /// The lever arms about the left and the right corner, m.
    fn arms(&self) -> [f64; 2] {
        [1.0, -1.0].map(|side| self.block.arm(side))
    }

    /// A lower bound of I/M - mu_h P^2 - mu_v Q^2 about a corner in any position: P^2 and Q^2 have a fixed sum, and
    /// each has its largest value here.
    fn swing_inertia(&self, b: f64) -> f64 {
        let block = &self.block;
        let radius2 = block.height * block.height + b * b;
        let least = block.inertia / block.mass + radius2 * (1.0 - self.mu_h.max(self.mu_v));
        self.impact_inertia(b).min(least)
    }
}
