//! One trial by the classical Runge-Kutta method. Twin of `shaders/rk4.wgsl`.

use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::dynamics::{Contact, Rates, rates};
use crate::model::excitation::Ground;
use crate::model::motion::Motion;
use crate::model::number::Number;

/// Where a trial ends.
#[derive(Debug, Clone, Copy)]
pub struct Stepped<R> {
    /// The motion at the end.
    pub y: Motion<R>,
    /// The contact force halfway, for the uplift condition and the extremes.
    pub mid: Contact<R>,
    /// The second derivatives of u and v halfway, where accelerations are requested.
    pub mid_base: [R; 2],
    /// The rates of the last stage: those at the end, but for terms of third order in the step.
    pub k4: Rates<R>,
}

/// The motion after a time `h` at the rates `k`.
#[inline(always)]
pub fn shift<R: Number>(y: &Motion<R>, k: &Rates<R>, h: R) -> Motion<R> {
    Motion {
        u: h.mul_add(k.du, y.u),
        du: h.mul_add(k.ddu, y.du),
        v: h.mul_add(k.dv, y.v),
        dv: h.mul_add(k.ddv, y.dv),
        z: h.mul_add(k.dz, y.z),
        phi: h.mul_add(k.dphi, y.phi),
        dphi: h.mul_add(k.ddphi, y.dphi),
    }
}

/// The motion a time `back` before the end `y` of a span of `h` seconds, whose rates are `k1` at the
/// start and `k` at the end and change evenly: to second order in `back`.
#[inline(always)]
pub fn shift_back<R: Number>(
    y: &Motion<R>,
    k1: &Rates<R>,
    k: &Rates<R>,
    back: R,
    h: R,
) -> Motion<R> {
    let half = h.like(0.5) * back * back;
    let change = half / h;
    let at = |x: R, rate: R, second: R| second + (-back).mul_add(rate, x);
    Motion {
        u: at(y.u, k.du, half * k.ddu),
        du: at(y.du, k.ddu, change * (k.ddu - k1.ddu)),
        v: at(y.v, k.dv, half * k.ddv),
        dv: at(y.dv, k.ddv, change * (k.ddv - k1.ddv)),
        z: at(y.z, k.dz, change * (k.dz - k1.dz)),
        phi: at(y.phi, k.dphi, half * k.ddphi),
        dphi: at(y.dphi, k.ddphi, change * (k.ddphi - k1.ddphi)),
    }
}

/// Steps over `h` seconds from the motion `y` with rates `k1`, the ground as it is halfway and at
/// the end.
#[inline(always)]
pub fn rk4<R: Number>(
    set: &CellEquations<R>,
    corner: &Corner<R>,
    rocking: R::Mask,
    y: &Motion<R>,
    k1: &Rates<R>,
    h: R,
    [ground_mid, ground_end]: [Ground<R>; 2],
) -> Stepped<R> {
    let half = h.like(0.5) * h;
    let k2 = rates(set, corner, rocking, &shift(y, k1, half), ground_mid);
    let k3 = rates(set, corner, rocking, &shift(y, &k2, half), ground_mid);
    let k4 = rates(set, corner, rocking, &shift(y, &k3, h), ground_end);
    let sixth = h.like(0.166_666_666_666_666_66) * h;
    let two = h.like(2.0);
    let end = Motion {
        u: sixth.mul_add(two.mul_add(k2.du + k3.du, k1.du + k4.du), y.u),
        du: sixth.mul_add(two.mul_add(k2.ddu + k3.ddu, k1.ddu + k4.ddu), y.du),
        v: sixth.mul_add(two.mul_add(k2.dv + k3.dv, k1.dv + k4.dv), y.v),
        dv: sixth.mul_add(two.mul_add(k2.ddv + k3.ddv, k1.ddv + k4.ddv), y.dv),
        z: sixth.mul_add(two.mul_add(k2.dz + k3.dz, k1.dz + k4.dz), y.z),
        phi: sixth.mul_add(two.mul_add(k2.dphi + k3.dphi, k1.dphi + k4.dphi), y.phi),
        dphi: sixth.mul_add(two.mul_add(k2.ddphi + k3.ddphi, k1.ddphi + k4.ddphi), y.dphi),
    };
    // Halfway the displacement of one stage lags by h^2/8 of its acceleration and that of the other
    // leads by as much.
    let mid = Contact {
        shear: h.like(0.5) * (k2.shear + k3.shear),
        normal: h.like(0.5) * (k2.normal + k3.normal),
    };
    let mid_base = match set.variant.asked.accelerations {
        true => [h.like(0.5) * (k2.ddu + k3.ddu), h.like(0.5) * (k2.ddv + k3.ddv)],
        false => [h; 2],
    };
    Stepped { y: end, mid, mid_base, k4 }
}

/// Value at the fraction `at` of the cubic through two ends with their slopes over `h`.
#[inline(always)]
pub fn hermite<R: Number>(x0: R, slope0: R, x1: R, slope1: R, at: R) -> R {
    let rise = x1 - x0;
    let c2 = at.like(3.0) * rise - at.like(2.0) * slope0 - slope1;
    let c3 = slope0 + slope1 - at.like(2.0) * rise;
    at.mul_add(at.mul_add(at.mul_add(c3, c2), slope0), x0)
}
