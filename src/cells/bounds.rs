//! Bounds of the certificate for a block on its base: the largest contact forces that an energy over M
//! allows while the block rocks. Symbols as in [`certificate`](crate::stepping::certificate).

use super::body::Body;

/// The lever on which a centripetal force acts.
#[derive(Clone, Copy)]
pub(crate) enum Lever {
    /// P, in the normal force.
    Height,
    /// Q, in the shear.
    Arm,
}

impl Body {
    /// b of the longer lever arm, H, and R of the longer arm, m.
    fn dimensions(&self) -> (f64, f64, f64) {
        let block = &self.block;
        let b = block.arm(1.0).max(block.arm(-1.0));
        (b, block.height, b.hypot(block.height))
    }

    /// rho^2 + kappa_h H^2: the least value of D, for P >= H and Q >= 0.
    fn least_d(&self) -> f64 {
        let block = &self.block;
        block.inertia / block.mass + (1.0 - self.mu_h) * block.height * block.height
    }

    /// The largest factor by which later impacts can raise the energy. By (15) none raises it, and neither does one
    /// with a factor up to [the largest](crate::scene::Case::most_restitution_factor). A coefficient of restitution E
    /// in place of the law multiplies the energy by E^2 I_l/I_r on the way from the right corner to the left, and by
    /// E^2 I_r/I_l on the way back: for E <= 1 never by more than the larger of the two ratios.
    pub(crate) fn impact_gain(&self) -> f64 {
        let Some(restitution) = self.restitution else { return 1.0 };
        let block = &self.block;
        let inertia =
            |side: f64| block.inertia / block.mass + block.height.powi(2) + block.arm(side).powi(2);
        let ratio = inertia(1.0) / inertia(-1.0);
        (restitution * restitution * ratio.max(1.0 / ratio)).max(1.0)
    }

    /// The least value of 1 - kappa_v Q^2/D: at Q = b and P = H.
    pub(crate) fn normal_share(&self) -> f64 {
        let (b, _, _) = self.dimensions();
        self.least_d() / (self.least_d() + (1.0 - self.mu_v) * b * b)
    }

    /// The largest value of P Q/D. The derivative shows that it falls from phi = 0 on where P >= Q and kappa_h P^2 >=
    /// kappa_v Q^2.
    pub(crate) fn most_pq(&self) -> f64 {
        let (b, h, r) = self.dimensions();
        let (kappa_h, kappa_v) = (1.0 - self.mu_h, 1.0 - self.mu_v);
        if h >= b && kappa_h * h * h >= kappa_v * b * b {
            return h * b / (self.least_d() + kappa_v * b * b);
        }
        r * b / self.least_d()
    }

    /// The largest value of a lever times w [1 +- (mu_h - mu_v) (other lever)^2/D] over the energy, by w <= 2 E/D.
    pub(crate) fn most_by_turn(&self, lever: Lever) -> f64 {
        let (b, _, r) = self.dimensions();
        let d = self.least_d();
        let other = (self.mu_h - self.mu_v).abs();
        let (lever, other) = match lever {
            Lever::Height => (r, other * b * b / d),
            Lever::Arm => (b, other * r * r / d),
        };
        2.0 * lever * (1.0 + other) / d
    }

    /// The least share of the inertia of u that remains where the block is free to rock: 1 - mu_h P^2 over the
    /// inertia about the corner less mu_v Q^2.
    pub(crate) fn free_share_h(&self) -> f64 {
        let (_, _, r) = self.dimensions();
        self.least_d() / (self.least_d() + self.mu_h * r * r)
    }

    /// The same for v.
    pub(crate) fn free_share_v(&self) -> f64 {
        let (b, _, _) = self.dimensions();
        self.least_d() / (self.least_d() + self.mu_v * b * b)
    }
}
