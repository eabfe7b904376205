//! What a cell carries from step to step, and what it has seen. Twin of `shaders/state.wgsl`.

use bytemuck::Zeroable;

use super::rk4::hermite;
use crate::model::block::{Corner, ROCKING_LEFT};
use crate::model::dynamics::{Motion, Rates};
use crate::model::excitation::Cell;
use crate::model::number::Number;
use crate::model::real::{Real, pod};

/// The cell still runs.
pub const RUNNING: u32 = 0;
/// The cell reached its last step.
pub const FINISHED: u32 = 1;
/// The block overturned about the left corner.
pub const OVERTURNED_LEFT: u32 = 2;
/// The block overturned about the right corner.
pub const OVERTURNED_RIGHT: u32 = 3;
/// More switches in one step than can be followed.
pub const EVENT_LIMIT: u32 = 4;
/// The motion left every physical range, or is not a number.
pub const DIVERGED: u32 = 5;
/// All that the cell tells was proved to be final.
pub const PROVED: u32 = 6;

/// One cell: its motion, its phase, and its records so far.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct State<R> {
    /// The motion at the last step boundary (or switch, for a cell that ended).
    pub motion: Motion<R>,
    /// Largest phi while rocking about the left corner, rad.
    pub max_phi_left: R,
    /// Largest -phi while rocking about the right corner, rad.
    pub max_phi_right: R,
    /// Largest |u|, m.
    pub max_u: R,
    /// Largest |v|, m.
    pub max_v: R,
    /// Least normal contact force over M, m/s^2.
    pub min_contact: R,
    /// Largest |horizontal| / normal contact force while the latter is positive.
    pub friction: R,
    /// Fraction of the step `uplift_step` at which the block first lifted.
    pub uplift_fraction: R,
    /// Fraction of the step `step` at which the block overturned.
    pub end_fraction: R,
    /// `FULL_CONTACT`, `ROCKING_LEFT` or `ROCKING_RIGHT`.
    pub mode: u32,
    /// Steps done.
    pub step: u32,
    /// Impacts so far.
    pub impacts: u32,
    /// Uplifts so far.
    pub uplifts: u32,
    /// Step in which the block first lifted.
    pub uplift_step: u32,
    /// `RUNNING`, or how the cell ended.
    pub status: u32,
}

pod!(State, reals: 15, words: 6);

/// Largest magnitude of a coordinate over a span, its interior extremum included.
#[inline(always)]
pub fn peak<N: Number>(x0: N, rate0: N, x1: N, rate1: N, h: N) -> N {
    let ends = x0.abs().max(x1.abs());
    let zero = h.like(0.0);
    let (rising0, rising1) = (rate0.exceeds(zero), rate1.exceeds(zero));
    let turns = (rising0 | rising1) & !(rising0 & rising1);
    if !N::any(turns) {
        return ends;
    }
    let at = rate0 / (rate0 - rate1);
    let extremum = hermite(x0, h * rate0, x1, h * rate1, at).abs();
    N::pick(turns, ends.max(extremum), ends)
}

/// Takes the motion over a span of length `h` seconds into the cell's largest values.
#[inline(always)]
pub fn observe_motion<R: Real>(state: &mut State<R>, y0: &Motion<R>, y1: &Motion<R>, h: R) {
    state.max_u = state.max_u.max(peak(y0.u, y0.du, y1.u, y1.du, h));
    state.max_v = state.max_v.max(peak(y0.v, y0.dv, y1.v, y1.dv, h));
    let angle = peak(y0.phi, y0.dphi, y1.phi, y1.dphi, h);
    if state.mode == ROCKING_LEFT {
        state.max_phi_left = state.max_phi_left.max(angle);
    } else {
        state.max_phi_right = state.max_phi_right.max(angle);
    }
}

/// Takes the contact forces of an instant into the cell's extremes.
#[inline(always)]
pub fn observe_contact<R: Real>(state: &mut State<R>, k: &Rates<R>) {
    if k.normal < state.min_contact {
        state.min_contact = k.normal;
    }
    let shear = k.shear.abs();
    if shear > state.friction * k.normal && k.normal > R::of(0.0) {
        state.friction = shear / k.normal;
    }
}

/// Ends the cell with the block overturned about `corner`.
#[inline(always)]
pub fn overturn<R: Real>(state: &mut State<R>, corner: &Corner<R>, fraction: R) {
    state.end_fraction = fraction;
    state.status = OVERTURNED_RIGHT;
    if corner.side > R::of(0.0) {
        state.status = OVERTURNED_LEFT;
    }
}

/// Ends a cell before it begins where one of its numbers is none: a parameter that the number type
/// does not hold.
pub fn check_cell<R: Real>(cell: &Cell<R>, state: &mut State<R>) {
    let numbers = [
        cell.post_yield,
        cell.hysteretic,
        cell.damping_h,
        cell.inverse_yield,
        cell.stiffness_v,
        cell.damping_v,
        cell.amplitude_h,
        cell.amplitude_v,
        cell.phase_step,
        cell.step_forced,
        cell.step_free,
        cell.rest_speed,
        cell.yield_energy,
        cell.deflection,
        cell.reach_h,
        cell.reach_v,
    ];
    if !numbers.iter().all(|number| number.to_f64().is_finite()) {
        state.status = DIVERGED;
    }
}

/// Largest |phi| that `sine` and `cosine` hold for, rad; overturning is at pi/2 at the latest.
pub const PHI_RANGE: f64 = 1.65;

/// Largest sum of |u|, |v|, |z| and |phi| that is taken for a motion.
pub const SIZE_RANGE: f64 = 1.0e4;

/// Ends a cell whose motion is out of every physical range: metres far beyond any base, which a
/// step past its stability limit reaches on its way to infinity, and angles for which there are no
/// sine and cosine.
#[inline(always)]
pub fn check_range<R: Real>(state: &mut State<R>) {
    if !is_sound(&state.motion) {
        state.status = DIVERGED;
    }
}

/// True where a motion is in the range of what a block and its base can do; what is not a number is
/// out of it.
#[inline(always)]
pub fn is_sound<N: Number>(y: &Motion<N>) -> N::Mask {
    let size = y.u.abs() + y.v.abs() + y.z.abs() + y.phi.abs();
    size.like(SIZE_RANGE).exceeds(size) & size.like(PHI_RANGE).reaches(y.phi.abs())
}
