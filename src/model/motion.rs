//! The state of a cell's motion. Twin of `shaders/motion.wgsl`.

use bytemuck::Zeroable;

use super::layout::{pod, reals};

/// The state of a cell's motion.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Motion<R> {
    /// u, horizontal displacement of the base, m.
    pub u: R,
    /// du/dt, m/s.
    pub du: R,
    /// v + g/omega_v^2, vertical displacement of the base from its static position, m: v itself would be
    /// rounded by the deflection that is in it.
    pub v: R,
    /// dv/dt, m/s.
    pub dv: R,
    /// z, hysteretic variable.
    pub z: R,
    /// phi, rotation of the block, rad.
    pub phi: R,
    /// dphi/dt, rad/s.
    pub dphi: R,
}

pod!(Motion, reals: 7, words: 0);
reals!(Motion, 7, u du v dv z phi dphi);
