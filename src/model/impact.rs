//! The change of the velocities at an impact. Twin of `shaders/impact.wgsl`.

use super::CellEquations;
use super::block::Corner;
use super::motion::Motion;
use super::number::Number;

/// After the impact the block turns about the other corner, `landing`: (16) with the coefficients (17).
#[inline(always)]
pub fn change_corner<R: Number>(landing: &Corner<R>, y: &Motion<R>) -> Motion<R> {
    Motion {
        u: y.u,
        du: y.du - landing.eta_u * y.dphi,
        v: y.v,
        dv: y.dv - landing.side * landing.eta_v * y.dphi,
        z: y.z,
        phi: y.phi.like(0.0),
        dphi: landing.eta_phi * y.dphi,
    }
}

/// The block comes to rest on both corners: the linear momenta of (15a) and (15b) are kept, and the rotation ends.
/// `leaving` is the corner about which the block turned.
#[inline(always)]
pub fn come_to_rest<R: Number>(
    set: &CellEquations<R>,
    leaving: &Corner<R>,
    y: &Motion<R>,
) -> Motion<R> {
    let model = set.model;
    Motion {
        u: y.u,
        du: y.du - model.mu_h * model.height * y.dphi,
        v: y.v,
        dv: y.dv + model.mu_v * leaving.side * leaving.arm * y.dphi,
        z: y.z,
        phi: y.phi.like(0.0),
        dphi: y.phi.like(0.0),
    }
}
