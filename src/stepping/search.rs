//! The search for the root of each lane's guard in its span, one trial of every lane at a time: Newton's
//! method inside a bracket, started at the root of the cubic through the span's ends. Twin of
//! `shaders/search.wgsl`.

use crate::model::number::Number;
use crate::model::real::Vector;

use super::cubic::Cubic;
use super::guards::{GuardSample, LOCATE_BOUND, Sought};

/// Lanes whose search is over.
pub struct Arrived<V: Vector> {
    /// Lanes whose root is found.
    pub lanes: V::Mask,
    /// How far before the trial's end the guard is, a fraction of the span: near enough to step back
    /// along the rates. Zero in all other lanes.
    pub back: V,
}

/// How far before a trial's end an angle passed its target, and the error of that distance; fractions of
/// the trial's span.
pub struct StepBack<N> {
    /// The way back.
    pub back: N,
    /// A bound on the terms of third order that the way back neglects.
    pub error: N,
}

/// The way back along the parabola that has the angle's value, slope and bend at a trial's end;
/// `bend_before` is its bend at the trial's start.
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

/// How far each lane's guard is from its trial's end.
pub struct RootDistance<V: Vector> {
    /// The guard's slope is not zero. Where it is zero no division by it is done: devices differ in NaN.
    pub steep: V::Mask,
    /// One over the slope.
    per_slope: V,
    /// Of an angle.
    pub way: StepBack<V>,
}

impl<V: Vector> RootDistance<V> {
    /// No distance.
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
    /// What each lane searches for.
    pub sought: Sought<V>,
    /// Lanes whose search found no root; their next trial takes the whole span.
    pub again: V::Mask,
    /// Where to try next, a fraction of the span.
    pub at: V,
    /// The guard is beyond `low`, and not beyond `high`.
    low: V,
    high: V,
    /// A trial that ended at `high` showed that the guard has happened there.
    verified: V::Mask,
    /// The next trial is the last.
    last: V::Mask,
    tries: V,
    /// The trial before, for the slope of an uplift moment.
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

    /// Begins the searches of lanes whose span holds a guard that has happened at `upper`, its end
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

    /// How far past the root the next trial aims, so that it ends beyond it. Zero for angles: the way
    /// back sets them to their target exactly.
    #[inline(always)]
    fn aim(&self) -> V {
        let (zero, half) = (self.at.like(0.0), self.at.like(0.5));
        V::select(self.sought.angle(), zero, half * self.sought.tolerance(zero))
    }

    /// How far the guards at the ends of the trials are; `bend_before` is an angle's bend at a
    /// trial's start. An uplift moment's slope is the secant from the trial before.
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

    /// Narrows the bracket by the result of the trial at `at`.
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
        // The next trial aims past the root by the value's rounding error; a value within twice that
        // error counts as found.
        let rounding = found.rounding;
        let change = V::select(angle, way.back, (found.value - rounding) * per_slope);
        let off = (found.value.abs() - rounding - rounding) * per_slope.abs();
        let near = steep & tolerance.ge(V::select(angle, way.error, off));
        // A guard that has not happened at the upper end of its bracket does not happen.
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
