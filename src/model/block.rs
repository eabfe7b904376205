//! The block and its two corners. Twin of `shaders/block.wgsl`.

use bytemuck::Zeroable;

use super::layout::{nested, pod, reals};

/// The block stands on both corners.
pub const FULL_CONTACT: u32 = 0;
/// The block turns about the left corner: phi > 0, counter-clockwise.
pub const ROCKING_LEFT: u32 = 1;
/// The block turns about the right corner: phi < 0.
pub const ROCKING_RIGHT: u32 = 2;

/// One corner of the base as a pivot.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Corner<R> {
    /// s: +1 for the left corner, -1 for the right.
    pub side: R,
    /// b = B + s e, the lever arm of the centre of mass, m.
    pub arm: R,
    /// rho^2 + b^2 + H^2 = I/M, m^2.
    pub inertia: R,
    /// |phi| at which the block counts as overturned about this corner, rad (section 2.6).
    pub overturn: R,
    /// eta_phi of (17c) for an impact after which the block turns about this corner.
    pub eta_phi: R,
    /// eta_u of (17a), m.
    pub eta_u: R,
    /// eta_v of (17b), m.
    pub eta_v: R,
    /// Padding: the size of the struct is a multiple of 16 bytes, as a uniform buffer requires.
    pub padding: R,
}

pod!(Corner, reals: 8, words: 0);
reals!(Corner, 8, side arm inertia overturn eta_phi eta_u eta_v padding);
pod!(Model, reals: 32, words: 0);

/// A body: the block and the mass ratios of its base. Cells whose numbers are equal share one body.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Model<R> {
    /// The left corner.
    pub left: Corner<R>,
    /// The right corner.
    pub right: Corner<R>,
    /// H, height of the centre of mass, m.
    pub height: R,
    /// mu_h = M/(M + m_h + m_v); zero where the horizontal direction is locked.
    pub mu_h: R,
    /// mu_v = M/(M + m_v); zero where the vertical direction is locked.
    pub mu_v: R,
    /// g, m/s^2.
    pub gravity: R,
    /// 1/mu_h; zero where the horizontal direction is locked.
    pub inverse_mu_h: R,
    /// 1/mu_v; zero where the vertical direction is locked.
    pub inverse_mu_v: R,
    /// The shorter of the two lever arms, m.
    pub least_arm: R,
    /// g (min R - H): the least energy over M with which the block can overturn about a corner, J/kg.
    pub topple_energy: R,
    /// The largest factor by which later impacts can raise the energy: 1 by the law of impact, (15). With a given
    /// coefficient of restitution an impact on the longer arm may raise the energy; the next impact lowers it again.
    pub impact_gain: R,
    /// Bounds on the contact forces while the block rocks ([`certificate`](crate::stepping::certificate)): the least
    /// value of 1 - kappa_v Q^2/D, the share of f_v in the normal force.
    pub normal_share: R,
    /// The largest value of kappa_v P Q/D, the share of f_h in the normal force.
    pub normal_by_shear: R,
    /// The largest value of kappa_v P w [1 - (mu_h - mu_v) Q^2/D] over the energy over M, 1/m.
    pub normal_by_turn: R,
    /// The largest value of kappa_h P Q/D, the share of f_v in the shear.
    pub shear_by_normal: R,
    /// The largest value of kappa_h Q w [1 + (mu_h - mu_v) P^2/D] over the energy over M, 1/m.
    pub shear_by_turn: R,
    /// Padding, as above.
    pub padding_0: R,
    /// Padding, as above.
    pub padding_1: R,
}

nested!(
    Model, left right;
    height mu_h mu_v gravity inverse_mu_h inverse_mu_v least_arm topple_energy impact_gain normal_share
    normal_by_shear normal_by_turn shear_by_normal shear_by_turn padding_0 padding_1;
);

/// The corner about which the block turns in a rocking mode. In full contact it is the left corner, and nothing reads
/// it.
#[inline(always)]
pub fn pivot<R: Copy>(model: &Model<R>, mode: u32) -> Corner<R> {
    if mode == ROCKING_RIGHT {
        return model.right;
    }
    model.left
}
