//! The search for the root of the guard of each lane in its span, one trial of every lane at a time: the method of
//! Newton inside a bracket, started at the root of the cubic through the ends of the span. Twin of
//! `shaders/search.wgsl`.

use crate::model::number::Number;
use crate::model::real::Vector;

use super::cubic::Cubic;
use super::guards::{GuardSample, LOCATE_BOUND, Sought};

/// The lanes whose search is over.
pub struct Arrived<V: Vector> {
    /// The lanes whose root is found.
    pub lanes: V::Mask,
    /// The distance of the root before the end of the trial, as a fraction of the span: it is small enough to step
    /// back along the rates. Zero in all other lanes.
    pub back: V,
}

/// The distance before the end of a trial at which an angle passed its target, and the error of that distance, as
/// fractions of the span of the trial.
pub struct StepBack<N> {
    /// The distance to step back.
    pub back: N,
    /// A bound on the terms of third order that this distance neglects.
    pub error: N,
}

/// The distance to step back along the parabola that has the value, the slope and the bend of the angle at the end of
/// a trial; `bend_before` is the bend at the start of the trial.
#[inline(always)]
fn step_back<N: Number>(end: &GuardSample<N>, per_slope: N, bend_before: N) -> StepBack<N> {
    let (half, sixth) = (per_slope.like(0.5), per_slope.like(1.0 / 6.0));
    let first = end.value * per_slope;
    let ratio = end.bend * per_slope;
    let second = half * first * first * ratio;
    let bends = (end.bend.abs() + bend_before.abs()) * per_slope.abs();
    let third = (second * ratio).abs() + sixth * first * first * bends;
    StepBack { back: first + second, error: first.abs() * third }
}

/// The distance of the guard of each lane from the end of its trial.
pub struct RootDistance<V: Vector> {
    /// True where the slope of the guard is not zero. Where it is zero there is no division by it, because devices
    /// differ in NaN.
    pub steep: V::Mask,
    /// One over the slope.
    per_slope: V,
    /// The distance to step back, for an angle.
    pub way: StepBack<V>,
}

impl<V: Vector> RootDistance<V> {
    /// No distance in any lane.
    #[inline(always)]
    pub fn none(zero: V) -> RootDistance<V> {
        RootDistance {
            steep: zero.mask(0),
            per_slope: zero,
            way: StepBack { back: zero, error: zero },
        }
    }
}

/// The searches of all lanes.
pub struct Search<V: Vector> {
    /// The guard that each lane searches for.
    pub sought: Sought<V>,
    /// The lanes whose search found no root; their next trial covers the whole span.
    pub again: V::Mask,
    /// The place of the next trial, as a fraction of the span.
    pub at: V,
    /// The bracket: the guard happens after `low`, and not after `high`.
    low: V,
    high: V,
    /// True where a trial that ended at `high` showed that the guard has happened there.
    verified: V::Mask,
    /// The next trial is the last.
    last: V::Mask,
    tries: V,
    /// The previous trial, for the slope of an uplift moment.
    before: V,
    value_before: V,
    slope: V,
}

impl<V: Vector> Search<V> {
    /// No search in any lane.
    #[inline(always)]
    pub fn new(zero: V) -> Search<V> {
        let none = zero.mask(0);
        Search {
            sought: Sought::nothing(zero),
            again: none,
            at: zero.like(1.0),
            low: zero,
            high: zero,
            verified: none,
            last: none,
            tries: zero,
            before: zero,
            value_before: zero,
            slope: zero,
        }
    }

    /// Begins the searches of lanes whose span has a guard that has happened at `upper`. This is the end of the span,
    /// unless the guard happens and is undone inside it.
    #[inline(always)]
    pub fn begin(&mut self, found: &Sought<V>, cubic: &Cubic<V>, upper: V) {
        let (zero, one) = (upper.like(0.0), upper.like(1.0));
        let lanes = found.any();
        self.sought.add(found);
        let (root, slope) = cubic.root();
        let whole = upper.ge(one);
        let first = V::select(whole, root + self.aim(), upper);
        self.at = V::select(lanes, first, self.at);
        self.low = V::select(lanes, zero, self.low);
        self.high = V::select(lanes, upper, self.high);
        self.tries = V::select(lanes, zero, self.tries);
        self.slope = V::select(lanes, slope, self.slope);
        self.verified = (self.verified & !lanes) | (lanes & whole);
        self.last = self.last & !lanes;
    }

    /// Ends all searches of some lanes.
    #[inline(always)]
    pub fn stop(&mut self, lanes: V::Mask) {
        self.sought.end(lanes);
        self.again = self.again & !lanes;
    }

    /// The distance beyond the root at which the next trial aims, so that it ends beyond the root. Zero for angles:
    /// the step back sets them exactly to their target.
    #[inline(always)]
    fn aim(&self) -> V {
        let (zero, half) = (self.at.like(0.0), self.at.like(0.5));
        V::select(self.sought.angle(), zero, half * self.sought.tolerance(zero))
    }

    /// The distances of the guards from the ends of the trials; `bend_before` is the bend of an angle at the start of
    /// a trial. The slope of an uplift moment is the secant from the previous trial.
    #[inline(always)]
    pub fn reach(&self, end: &GuardSample<V>, bend_before: V) -> RootDistance<V> {
        let (zero, one) = (end.value.like(0.0), end.value.like(1.0));
        let by_secant = self.sought.uplift & self.tries.gt(zero);
        let first = V::select(self.sought.uplift, self.slope, end.slope);
        let slope = V::select(by_secant, end.value - self.value_before, first);
        let steep = slope.abs().gt(zero);
        let across = V::select(by_secant, self.at - self.before, one);
        let per_slope = across / V::select(steep, slope, one);
        RootDistance { steep, per_slope, way: step_back(end, per_slope, bend_before) }
    }

    /// Narrows the bracket with the result of the trial at `at`.
    #[inline(always)]
    pub fn narrow(&mut self, found: GuardSample<V>, reach: &RootDistance<V>) -> Arrived<V> {
        let (zero, one, half) =
            (found.value.like(0.0), found.value.like(1.0), found.value.like(0.5));
        let RootDistance { steep, per_slope, way } = reach;
        let (steep, per_slope) = (*steep, *per_slope);
        let seeking = self.sought.any();
        let angle = self.sought.angle();
        let tolerance = self.sought.tolerance(zero);
        let at = self.at;
        self.before = at;
        self.value_before = found.value;
        self.tries = self.tries + one;
        let beyond = found.value.gt(zero);
        // The next trial aims beyond the root by the rounding error of the value; a value within twice that error
        // counts as found.
        let rounding = found.rounding;
        let change = V::select(angle, way.back, (found.value - rounding) * per_slope);
        let off = (found.value.abs() - rounding - rounding) * per_slope.abs();
        let near = steep & tolerance.ge(V::select(angle, way.error, off));
        // A guard that has not happened at the upper end of its bracket does not happen at all.
        let nothing = seeking & !self.verified & !beyond & at.ge(self.high);
        let done = seeking & ((near & (beyond | angle)) | self.last) & !nothing;
        self.high = V::select(beyond, at, self.high);
        self.low = V::select(beyond, self.low, at);
        self.verified = self.verified | (seeking & beyond);
        let next = at - change + self.aim();
        let inside = steep & next.gt(self.low) & self.high.gt(next);
        let next = V::select(inside, next, half * (self.low + self.high));
        let narrow =
            tolerance.ge(self.high - self.low) | self.tries.ge(one.like(f64::from(LOCATE_BOUND)));
        self.last = seeking & narrow;
        self.at = V::select(seeking, V::select(narrow, self.high, next), at);
        self.again = self.again | nothing;
        let back = V::select(done & angle & near, change, zero);
        let over = done | nothing;
        self.sought.end(over);
        self.at = V::select(over, one, self.at);
        Arrived { lanes: done, back }
    }
}
