//! One step, or a part of one, by the classical Runge-Kutta method. Twin of `shaders/rk4.wgsl`.

use crate::model::Setting;
use crate::model::block::Corner;
use crate::model::dynamics::{Motion, Rates, rates};
use crate::model::excitation::{Ground, ground_at, step_length};
use crate::model::number::Number;
use crate::model::real::Real;

/// What a (sub)step is taken with: everything that stays the same inside it.
#[derive(Debug, Clone, Copy)]
pub struct Span<R> {
    /// The corner that the block turns about.
    pub corner: Corner<R>,
    /// False in full contact.
    pub rocking: bool,
    /// Index of the step.
    pub step: u32,
    /// Fraction of the step already done.
    pub start: R,
    /// Fraction of the step that is looked at: the rest of it, or what is left up to a kink.
    pub length: R,
}

/// Where a (sub)step ends.
#[derive(Debug, Clone, Copy)]
pub struct Stepped<R> {
    /// The motion at the end.
    pub y: Motion<R>,
    /// Contact forces over M halfway, for the uplift condition.
    pub shear_mid: R,
    /// See `shear_mid`.
    pub normal_mid: R,
}

/// The motion after a time `h` at the rates `k`.
#[inline(always)]
pub fn shift<R: Number>(y: &Motion<R>, k: &Rates<R>, h: R) -> Motion<R> {
    Motion {
        u: h.times_plus(k.du, y.u),
        du: h.times_plus(k.ddu, y.du),
        v: h.times_plus(k.dv, y.v),
        dv: h.times_plus(k.ddv, y.dv),
        z: h.times_plus(k.dz, y.z),
        phi: h.times_plus(k.dphi, y.phi),
        dphi: h.times_plus(k.ddphi, y.dphi),
    }
}

/// Steps over `h` seconds from the motion `y` with rates `k1`, the ground as it is halfway and at
/// the end.
#[inline(always)]
pub fn rk4<R: Number>(
    set: &Setting<R>,
    corner: &Corner<R>,
    rocking: R::Mask,
    y: &Motion<R>,
    k1: &Rates<R>,
    h: R,
    ground: [Ground<R>; 2],
) -> Stepped<R> {
    let half = h.like(0.5) * h;
    let [ground_mid, ground_end] = ground;
    let k2 = rates(set, corner, rocking, &shift(y, k1, half), ground_mid);
    let k3 = rates(set, corner, rocking, &shift(y, &k2, half), ground_mid);
    let k4 = rates(set, corner, rocking, &shift(y, &k3, h), ground_end);
    let sixth = h.like(0.166_666_666_666_666_66) * h;
    let two = h.like(2.0);
    let end = Motion {
        u: sixth.times_plus(two.times_plus(k2.du + k3.du, k1.du + k4.du), y.u),
        du: sixth.times_plus(two.times_plus(k2.ddu + k3.ddu, k1.ddu + k4.ddu), y.du),
        v: sixth.times_plus(two.times_plus(k2.dv + k3.dv, k1.dv + k4.dv), y.v),
        dv: sixth.times_plus(two.times_plus(k2.ddv + k3.ddv, k1.ddv + k4.ddv), y.dv),
        z: sixth.times_plus(two.times_plus(k2.dz + k3.dz, k1.dz + k4.dz), y.z),
        phi: sixth.times_plus(two.times_plus(k2.dphi + k3.dphi, k1.dphi + k4.dphi), y.phi),
        dphi: sixth.times_plus(two.times_plus(k2.ddphi + k3.ddphi, k1.ddphi + k4.ddphi), y.dphi),
    };
    Stepped { y: end, shear_mid: k3.shear, normal_mid: k3.normal }
}

/// Steps over `length`, a fraction of the step, from the start of the span.
#[inline(always)]
pub fn trial<R: Real>(
    set: &Setting<R>,
    span: &Span<R>,
    y: &Motion<R>,
    k1: &Rates<R>,
    length: R,
) -> Stepped<R> {
    let h = length * step_length(set.cell, span.step);
    let ground_mid = ground_at(set, span.step, span.start + R::of(0.5) * length);
    let ground_end = ground_at(set, span.step, span.start + length);
    rk4(set, &span.corner, span.rocking, y, k1, h, [ground_mid, ground_end])
}

/// Value at the fraction `at` of the cubic through two ends with their slopes over `h`.
#[inline(always)]
pub fn hermite<R: Number>(x0: R, slope0: R, x1: R, slope1: R, at: R) -> R {
    let rise = x1 - x0;
    let c2 = at.like(3.0) * rise - at.like(2.0) * slope0 - slope1;
    let c3 = slope0 + slope1 - at.like(2.0) * rise;
    at.times_plus(at.times_plus(at.times_plus(c3, c2), slope0), x0)
}
