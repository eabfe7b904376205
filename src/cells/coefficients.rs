//! The coefficients of the equations of motion of a body.

use super::body::Body;
use super::bounds::Lever;
use crate::model::block::{Corner, Model};
use crate::model::real::Real;
use crate::scene::GRAVITY;

impl Body {
    /// One corner; `side` is +1 for the left, -1 for the right.
    fn corner<R: Real>(&self, side: f64) -> Corner<R> {
        let block = &self.block;
        let rho2 = block.inertia / block.mass;
        let (h, b, c) = (block.height, block.arm(side), block.arm(-side));
        let width = 2.0 * block.half_width;
        let (kappa_h, kappa_v) = (1.0 - self.mu_h, 1.0 - self.mu_v);
        let d = self.impact_inertia(b);
        let by_law = (rho2 + h * h * kappa_h - b * c * kappa_v) / d;
        // The share of the rotation that the factor adds to that of the law of impact; zero for the law itself.
        let (factor, less) = (self.restitution_factor, (1.0 - self.restitution_factor) * by_law);
        Corner {
            side: R::of(side),
            arm: R::of(b),
            inertia: R::of(rho2 + b * b + h * h),
            overturn: R::of(block.overturning_angle(side, self.overturn)),
            eta_phi: R::of(self.restitution.unwrap_or(factor * by_law)),
            eta_u: R::of(width * b * h * self.mu_h * kappa_v / d + self.mu_h * h * less),
            eta_v: R::of(width * self.mu_v * (h * h * kappa_h + rho2) / d - self.mu_v * b * less),
            padding: R::of(0.0),
        }
    }

    /// The coefficients of the equations of this body.
    pub fn model<R: Real>(&self) -> Model<R> {
        let block = &self.block;
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
}
