//! The equations of motion. Twin of `shaders/dynamics.wgsl`.

use super::CellEquations;
use super::block::Corner;
use super::excitation::Ground;
use super::isolation::{hysteretic_rate, pendulum_slope, support};
use super::motion::Motion;
use super::number::Number;

/// The rates of change of a motion, and the forces between block and base that come with them.
#[derive(Debug, Clone, Copy)]
pub struct Rates<R> {
    /// du/dt.
    pub du: R,
    /// Second derivative of u, m/s^2.
    pub ddu: R,
    /// dv/dt.
    pub dv: R,
    /// Second derivative of v, m/s^2.
    pub ddv: R,
    /// dz/dt, 1/s.
    pub dz: R,
    /// dphi/dt.
    pub dphi: R,
    /// Second derivative of phi, rad/s^2.
    pub ddphi: R,
    /// Normal contact force over M, m/s^2.
    pub normal: R,
    /// Horizontal contact force over M, m/s^2.
    pub shear: R,
}

/// The force between block and base over M.
#[derive(Debug, Clone, Copy)]
pub struct Contact<R> {
    /// Horizontal, m/s^2.
    pub shear: R,
    /// Normal, m/s^2; negative where the model would have to pull the block down.
    pub normal: R,
}

impl<R: Copy> Rates<R> {
    /// The contact force that belongs to the rates.
    #[inline(always)]
    pub fn contact(&self) -> Contact<R> {
        Contact { shear: self.shear, normal: self.normal }
    }
}

/// The lever of the centre of mass about a corner.
#[derive(Debug, Clone, Copy)]
pub struct Lever<R> {
    /// P = H cos phi + s b sin phi, its height, m.
    pub p: R,
    /// Q = s b cos phi - H sin phi, m.
    pub q: R,
}

/// P and Q at an angle.
#[inline(always)]
pub fn lever_at<R: Number>(set: &CellEquations<R>, corner: &Corner<R>, phi: R) -> Lever<R> {
    let height = set.model.height;
    let sin_phi = phi.sine();
    let cos_phi = phi.cosine();
    let arm = corner.side * corner.arm;
    Lever {
        p: height.mul_add(cos_phi, arm * sin_phi),
        q: arm.mul_add(cos_phi, -(height * sin_phi)),
    }
}

/// The rates of the motion: (5) in full contact, (9) while the block rocks.
///
/// (9c) with (9a) and (9b) eliminated is one division:
/// `ddphi = [P (f_h + mu_h Q dphi^2) - Q (f_v + mu_v P dphi^2)] / [I/M - mu_h P^2 - mu_v Q^2]`.
#[inline(always)]
pub fn rates<R: Number>(
    set: &CellEquations<R>,
    corner: &Corner<R>,
    rocking: R::Mask,
    y: &Motion<R>,
    ground: Ground<R>,
) -> Rates<R> {
    let (variant, model) = (set.variant, set.model);
    let zero = y.phi.like(0.0);
    let base = support(set, y, ground);
    // X and Y, the base's absolute accelerations (Y with g).
    let mut x_base = base.f_h;
    let mut y_base = base.f_v;
    let mut ddphi = zero;
    let mut normal = base.f_v;
    let mut shear = base.f_h;
    if R::any(rocking) {
        let Lever { p, q } = lever_at(set, corner, y.phi);
        let w = y.dphi * y.dphi;
        let (mu_p, mu_q) = (model.mu_h * p, model.mu_v * q);
        let mut push_h = (model.mu_h * q).mul_add(w, base.f_h);
        let push_v = (model.mu_v * p).mul_add(w, base.f_v);
        let inertia = (-mu_p).mul_add(p, (-mu_q).mul_add(q, corner.inertia));
        let mut turn = p.mul_add(push_h, -(q * push_v)) / inertia;
        if variant.devices && variant.follows && !variant.isolated_v {
            // The rotation changes the force on the pendulum, too: the angular acceleration stands on both sides of
            // (9a).
            let (slope, weight) = (pendulum_slope(set, y), base.f_v);
            let rest = slope.mul_add(weight.max(zero), push_h);
            let still = (-mu_p).mul_add(w, weight);
            let moment = p.mul_add((-slope).mul_add(still, rest), -(q * push_v));
            let pressed = moment / (slope * mu_p).mul_add(q, inertia);
            let pressure = (model.mu_h * q).mul_add(pressed, still);
            let held = pressure.gt(zero);
            turn = R::select(held, pressed, p.mul_add(rest, -(q * push_v)) / inertia);
            push_h = (-slope).mul_add(pressure.max(zero), rest);
        }
        ddphi = R::select(rocking, turn, zero);
        x_base = R::select(rocking, mu_p.mul_add(turn, push_h), x_base);
        y_base = R::select(rocking, (-mu_q).mul_add(turn, push_v), y_base);
        shear = R::select(rocking, (-p).mul_add(turn, (-q).mul_add(w, x_base)), shear);
        normal = R::select(rocking, q.mul_add(turn, (-p).mul_add(w, y_base)), normal);
    }
    let mut ddu = zero;
    let mut dz = zero;
    if variant.isolated_h {
        ddu = x_base - ground.h;
    }
    if variant.yields {
        dz = hysteretic_rate(set, y);
    }
    let mut ddv = zero;
    if variant.isolated_v {
        ddv = y_base - ground.v - model.gravity;
    }
    Rates { du: y.du, ddu, dv: y.dv, ddv, dz, dphi: y.dphi, ddphi, normal, shear }
}

/// The uplift condition (14) about a corner, as a moment over M: s H X - b Y, positive where the
/// block lifts. The same terms drive `ddphi` at phi = 0, so that both agree about its sign.
#[inline(always)]
pub fn uplift_moment<R: Number>(
    set: &CellEquations<R>,
    corner: &Corner<R>,
    contact: Contact<R>,
) -> R {
    corner.side * set.model.height * contact.shear - corner.arm * contact.normal
}

/// The larger of the two uplift moments: positive where the block lifts about either corner. Where
/// both are positive at once, as for X = 0 and Y < 0, the larger one turns the block first.
#[inline(always)]
pub fn largest_uplift_moment<R: Number>(set: &CellEquations<R>, contact: Contact<R>) -> R {
    let left = uplift_moment(set, &set.model.left, contact);
    let right = uplift_moment(set, &set.model.right, contact);
    left.max(right)
}
