//! The guards: functions of the motion at whose roots a step is cut. Twin of `shaders/guards.wgsl`.
//!
//! A guard is positive after its event has happened.
//!
//! | guard | value | slope over the span | located to, of a step | what happens there |
//! |---|---|---|---|---|
//! | uplift | the larger uplift moment (14), s H X - b Y | secant of two trials | `EVENT_TOLERANCE`, or twice its rounding | the block lifts about the corner of the larger moment |
//! | impact | -s phi | -s h phi' | `EVENT_TOLERANCE` | (16), or rest on both corners |
//! | overturning | s phi - phi_c | s h phi' | `EVENT_TOLERANCE` | the cell ends |
//! | kink of u' | u', its sign at the start reversed | h u'' | `KINK_TOLERANCE` | the step is cut: the law (11) is smooth on either side |
//! | kink of z | z, its sign at the start reversed | h z' | `KINK_TOLERANCE` | the same |
//! | end stop | its guard, the smaller of the spring's push and the whole force, or that reversed | h times its rate | `EVENT_TOLERANCE`, or twice its rounding | the step is cut: the base meets its stop, or leaves it |
//!
//! Two more cuts need no search: the limit of stability of (11), and the impact that is estimated from the rates
//! ([`span`](super::span)). A step never goes beyond the end of its forcing segment ([`forcing`](super::forcing)).

use crate::model::CellEquations;
use crate::model::dynamics::Rates;
use crate::model::isolation::{side_of, stop_force};
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};

/// No switch.
pub const NOTHING: u32 = 0;
/// The block lifts about the left corner.
pub const UPLIFT_LEFT: u32 = 1;
/// The block lifts about the right corner.
pub const UPLIFT_RIGHT: u32 = 2;
/// The block lands on the other corner.
pub const IMPACT: u32 = 3;
/// The block passes the overturning angle.
pub const OVERTURN: u32 = 4;
/// The step is cut, and the phase stays: du or z changes sign, or z would relax too fast for the step.
pub const KINK: u32 = 5;

/// The most switches in one step. A block that chatters to rest makes about
/// [`FLIGHTS_A_STEP`](crate::cells::groups::FLIGHTS_A_STEP) impacts in its last step.
pub const EVENT_BOUND: u32 = 128;
/// The most trials of one search.
pub const LOCATE_BOUND: u32 = 60;

/// The guard that each lane searches for, one at most.
#[derive(Clone, Copy)]
pub struct Sought<V: Vector> {
    /// An uplift; its corner is decided when the uplift is found.
    pub uplift: V::Mask,
    /// An impact.
    pub impact: V::Mask,
    /// The overturning angle.
    pub overturning: V::Mask,
    /// A change of sign of u'.
    pub kink_u: V::Mask,
    /// A change of sign of z.
    pub kink_z: V::Mask,
    /// The base meets its end stop, or leaves it.
    pub stop: V::Mask,
}

impl<V: Vector> Sought<V> {
    /// No search in any lane.
    #[inline(always)]
    pub fn nothing(zero: V) -> Sought<V> {
        let none = zero.mask(0);
        Sought {
            uplift: none,
            impact: none,
            overturning: none,
            kink_u: none,
            kink_z: none,
            stop: none,
        }
    }

    /// The lanes that search for a kink.
    #[inline(always)]
    pub fn kink(&self) -> V::Mask {
        self.smooth_kink() | self.stop
    }

    /// The lanes that search for a kink without a jump of a force.
    #[inline(always)]
    fn smooth_kink(&self) -> V::Mask {
        self.kink_u | self.kink_z
    }

    /// The lanes that search for an angle: its distance follows from the rates at the end of a trial.
    #[inline(always)]
    pub fn angle(&self) -> V::Mask {
        self.impact | self.overturning
    }

    /// The lanes that search for any guard.
    #[inline(always)]
    pub fn any(&self) -> V::Mask {
        self.kink() | self.angle() | self.uplift
    }

    /// The tolerance of the time of a guard, as a fraction of the step.
    #[inline(always)]
    pub fn tolerance(&self, zero: V) -> V {
        let event = zero.like(V::Element::EVENT_TOLERANCE.to_f64());
        let kink = zero.like(V::Element::KINK_TOLERANCE.to_f64());
        V::select(self.smooth_kink(), kink, event)
    }

    /// Adds the searches of another set; no lane is in both sets.
    #[inline(always)]
    pub fn add(&mut self, other: &Sought<V>) {
        self.uplift = self.uplift | other.uplift;
        self.impact = self.impact | other.impact;
        self.overturning = self.overturning | other.overturning;
        self.kink_u = self.kink_u | other.kink_u;
        self.kink_z = self.kink_z | other.kink_z;
        self.stop = self.stop | other.stop;
    }

    /// Ends the searches of some lanes.
    #[inline(always)]
    pub fn end(&mut self, lanes: V::Mask) {
        self.uplift = self.uplift & !lanes;
        self.impact = self.impact & !lanes;
        self.overturning = self.overturning & !lanes;
        self.kink_u = self.kink_u & !lanes;
        self.kink_z = self.kink_z & !lanes;
        self.stop = self.stop & !lanes;
    }
}

/// A guard at the end of a trial.
#[derive(Clone, Copy)]
pub struct GuardSample<N> {
    /// The value of the guard; positive after its event has happened.
    pub value: N,
    /// The slope of the guard over the span.
    pub slope: N,
    /// The change of this slope over the span, by the rates at this end.
    pub bend: N,
    /// A bound on the rounding error of the value.
    pub rounding: N,
}

/// True where a number changes from one side of zero to the other; zero itself is on neither side.
#[inline(always)]
pub fn crosses<N: Number>(start: N, end: N) -> N::Mask {
    let zero = start.like(0.0);
    (start.gt(zero) & zero.gt(end)) | (zero.gt(start) & end.gt(zero))
}

/// Impact or overturning: by how much the angle exceeds a target, in the direction +1 or -1.
#[inline(always)]
pub fn angle_guard<N: Number>(
    sense: N,
    target: N,
    y: &Motion<N>,
    k: &Rates<N>,
    h: N,
) -> GuardSample<N> {
    GuardSample {
        value: sense * y.phi - target,
        slope: h * sense * y.dphi,
        bend: h * h * sense * k.ddphi,
        rounding: h.like(0.0),
    }
}

/// A kink: u' or z, positive after it has left the side of zero on which it was at the start.
#[inline(always)]
pub fn kink_guard<N: Number>(
    of_z: N::Mask,
    start: &Motion<N>,
    y: &Motion<N>,
    k: &Rates<N>,
    h: N,
) -> GuardSample<N> {
    let zero = h.like(0.0);
    let from = N::select(of_z, start.z, start.du);
    let value = N::select(of_z, y.z, y.du);
    let slope = h * N::select(of_z, k.dz, k.ddu);
    let positive = from.gt(zero);
    GuardSample {
        value: N::select(positive, -value, value),
        slope: N::select(positive, -slope, slope),
        bend: zero,
        rounding: zero,
    }
}

/// The end stop: positive if the base is against a stop that it did not touch at the start of the span, or if it has
/// left the stop that it touched. The value of the guard is an acceleration; its slope is over a span of `h` seconds.
#[inline(always)]
pub fn end_stop_guard<N: Number>(
    set: &CellEquations<N>,
    y: &Motion<N>,
    k: &Rates<N>,
    h: N,
    rounding: N,
) -> GuardSample<N> {
    let (zero, cell) = (h.like(0.0), set.cell);
    let side = side_of(y.u);
    let pushed = cell.horizontal.stop_stiffness * (side * y.u - cell.horizontal.stop_gap);
    let force = stop_force(set, side, y);
    let value = pushed.min(force);
    let mut slope = cell.horizontal.stop_stiffness * side * y.du;
    let damped = cell.horizontal.stop_damping * side * k.ddu;
    slope = N::select(pushed.gt(force), slope + damped, slope);
    let off = zero.ge(set.stop.copied().unwrap_or(zero).abs());
    let damping = cell.horizontal.stop_damping * y.du.abs();
    let size =
        cell.horizontal.stop_stiffness.mul_add(y.u.abs() + cell.horizontal.stop_gap, damping);
    GuardSample {
        value: N::select(off, value, -value),
        slope: h * N::select(off, slope, -slope),
        bend: zero,
        rounding: rounding * size,
    }
}
