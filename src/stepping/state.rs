//! What a cell carries from dispatch to dispatch, and its extremes so far. Twin of `shaders/state.wgsl`.

use bytemuck::Zeroable;

use crate::model::excitation::Cell;
use crate::model::layout::pod;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::Real;

use super::extremes::Extremes;

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
/// Energy proved that all results of the cell are final.
pub const PROVED: u32 = 6;

/// One cell: its motion, its phase, its counts and its extremes so far.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct State<R> {
    /// The motion at the last step boundary (or switch, for a cell that ended).
    pub motion: Motion<R>,
    /// The largest and least values so far.
    pub extremes: Extremes<R>,
    /// Fraction of the step `uplift_step` at which the block first lifted.
    pub uplift_fraction: R,
    /// Fraction of the step `step` at which the cell ended, if it did not reach its last step.
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

pod!(State, reals: 23, words: 6);

/// Ends a cell before it begins where one of its numbers is not finite: the number type does not hold a
/// parameter.
pub fn check_cell<R: Real>(cell: &Cell<R>, state: &mut State<R>) {
    let Cell { horizontal, vertical, drive, steps, .. } = cell;
    let rest = [&vertical.reals()[..], &drive.reals(), &steps.reals()].concat();
    if !horizontal.reals().iter().chain(&rest).all(|number| number.to_f64().is_finite()) {
        state.status = DIVERGED;
    }
}

/// Largest |phi| that `sine` and `cosine` hold for, rad; overturning is at pi/2 at the latest.
pub const PHI_RANGE: f64 = 1.65;

/// Largest sum of |u|, |v|, |z| and |phi| of a valid motion: far beyond any base, in metres. A step
/// beyond the limit of stability grows past it.
pub const SIZE_RANGE: f64 = 1.0e4;

/// True where a motion is in the range of what a block and its base can do; NaN is out of range.
#[inline(always)]
pub fn is_finite<N: Number>(y: &Motion<N>) -> N::Mask {
    let size = y.u.abs() + y.v.abs() + y.z.abs() + y.phi.abs();
    size.like(SIZE_RANGE).gt(size) & size.like(PHI_RANGE).ge(y.phi.abs())
}
