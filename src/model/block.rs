//! The block and its two corners. Twin of `shaders/block.wgsl`.

use bytemuck::Zeroable;

use super::real::{pod, reals};

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
    /// Fills the struct to whole 16 bytes, as a uniform buffer asks for.
    pub padding: R,
}

pod!(Corner, reals: 8, words: 0);
reals!(Corner, 8, side arm inertia overturn eta_phi eta_u eta_v padding);
pod!(Model, reals: 24, words: 0);

/// What every cell of a sweep shares: the block, and the mass ratios of its base.
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
    /// g (min R - H): energy over M without which no corner is overturned about, J/kg.
    pub topple_energy: R,
}

/// The corner that the block turns about in a rocking mode (the left one in full contact, where
/// nothing asks for it).
#[inline(always)]
pub fn pivot<R: Copy>(model: &Model<R>, mode: u32) -> Corner<R> {
    if mode == ROCKING_RIGHT {
        return model.right;
    }
    model.left
}
