//! Where in its span each lane's switch or kink is, a trial of every lane at a time: Newton's
//! method inside a bracket, from the cubic through the span's ends.

use crate::model::dynamics::{Motion, Rates};
use crate::model::real::Real;
use crate::model::vector::Vector;

use super::super::locate::LOCATE_BOUND;
use super::cubic::{Beyond, Cubic};

/// Lanes whose search is over.
pub struct Arrived<V: Vector> {
    /// Those that have arrived.
    pub lanes: V::Mask,
    /// How far before the trial's end the switch is, a fraction of the span: near enough to go back
    /// along the rates. Zero in all other lanes.
    pub back: V,
}

/// The searches of all lanes.
pub struct Seek<V: Vector> {
    /// Lanes that look for a kink.
    pub kinking: V::Mask,
    /// Lanes that look for an impact or an overturning.
    pub turning: V::Mask,
    /// Lanes that look for an uplift.
    pub lifting: V::Mask,
    /// Lanes that found nothing and take their span whole.
    pub again: V::Mask,
    /// Where to try next, a fraction of the span.
    pub at: V,
    /// What is looked for is beyond `low`, and not beyond `high`.
    low: V,
    high: V,
    /// It was found to have happened at `high`.
    verified: V::Mask,
    /// The next trial is the last.
    last: V::Mask,
    tries: V,
    /// The trial before, for the slope of an uplift moment.
    before: V,
    value_before: V,
    slope: V,
}

impl<V: Vector> Seek<V> {
    /// No search in any lane.
    #[inline(always)]
    pub fn new(zero: V) -> Seek<V> {
        let none = zero.mask(0);
        Seek {
            kinking: none,
            turning: none,
            lifting: none,
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

    /// Lanes that look for anything.
    #[inline(always)]
    pub fn seeking(&self) -> V::Mask {
        self.kinking | self.turning | self.lifting
    }

    /// Begins the search of lanes whose span holds a switch that has happened at `upper`, its end
    /// unless the switch happens and is undone inside it.
    #[inline(always)]
    pub fn begin(&mut self, lanes: V::Mask, cubic: &Cubic<V>, upper: V) {
        let (zero, one) = (upper.like(0.0), upper.like(1.0));
        let (root, slope) = cubic.root();
        let whole = upper.reaches(one);
        let first = V::pick(whole, self.offset(root), upper);
        self.at = V::pick(lanes, first, self.at);
        self.low = V::pick(lanes, zero, self.low);
        self.high = V::pick(lanes, upper, self.high);
        self.tries = V::pick(lanes, zero, self.tries);
        self.slope = V::pick(lanes, slope, self.slope);
        self.verified = (self.verified & !lanes) | (lanes & whole);
        self.last = self.last & !lanes;
    }

    /// Ends all searches of some lanes.
    #[inline(always)]
    pub fn stop(&mut self, lanes: V::Mask) {
        self.kinking = self.kinking & !lanes;
        self.turning = self.turning & !lanes;
        self.lifting = self.lifting & !lanes;
        self.again = self.again & !lanes;
    }

    /// How near a place must be found.
    #[inline(always)]
    fn tolerance(&self) -> V {
        let event = self.at.like(V::Element::EVENT_TOLERANCE.to_f64());
        let kink = self.at.like(V::Element::KINK_TOLERANCE.to_f64());
        V::pick(self.kinking, kink, event)
    }

    /// A place that is beyond where `at` is as good as on the switch, but for angles, which are zero
    /// by definition there.
    #[inline(always)]
    fn offset(&self, at: V) -> V {
        let half = at.like(0.5);
        V::pick(self.turning, at, at + half * self.tolerance())
    }

    /// Takes in what the trial at `at` came to.
    #[inline(always)]
    pub fn narrow(&mut self, found: Beyond<V>) -> Arrived<V> {
        let (zero, one, half) =
            (found.value.like(0.0), found.value.like(1.0), found.value.like(0.5));
        let seeking = self.seeking();
        let at = self.at;
        let secant = (found.value - self.value_before) / (at - self.before);
        let repeated = self.tries.exceeds(zero);
        self.slope = V::pick(self.lifting, V::pick(repeated, secant, self.slope), found.slope);
        self.before = at;
        self.value_before = found.value;
        self.tries = self.tries + one;
        let change = found.value / self.slope;
        let beyond = found.value.exceeds(zero);
        // Going back along the slope misses half the bend times the square of the way.
        let missed = half * change * change * found.bend.abs();
        let near = V::pick(self.turning, missed, (change * self.slope).abs());
        let near = (self.tolerance() * self.slope.abs()).reaches(near);
        // What has not happened at the upper end does not happen.
        let nothing = seeking & !self.verified & !beyond & at.reaches(self.high);
        let done = seeking & ((near & (beyond | self.turning)) | self.last) & !nothing;
        self.high = V::pick(beyond, at, self.high);
        self.low = V::pick(beyond, self.low, at);
        self.verified = self.verified | (seeking & beyond);
        let next = self.offset(at - change);
        let inside = next.exceeds(self.low) & self.high.exceeds(next);
        let next = V::pick(inside, next, half * (self.low + self.high));
        let narrow = self.tolerance().reaches(self.high - self.low)
            | self.tries.reaches(one.like(f64::from(LOCATE_BOUND)));
        self.last = seeking & narrow;
        self.at = V::pick(seeking, V::pick(narrow, self.high, next), at);
        self.again = self.again | nothing;
        let back = V::pick(done & self.turning & near, change, zero);
        let over = done | nothing;
        self.kinking = self.kinking & !over;
        self.turning = self.turning & !over;
        self.lifting = self.lifting & !over;
        self.at = V::pick(over, one, self.at);
        Arrived { lanes: done, back }
    }
}

/// A coordinate that a kink changes the sign of, as a [`Beyond`] of the sign at the start.
#[inline(always)]
pub fn of_kink<V: Vector>(
    of_z: V::Mask,
    start: &Motion<V>,
    y: &Motion<V>,
    k: &Rates<V>,
    h: V,
) -> Beyond<V> {
    let from = V::pick(of_z, start.z, start.du);
    let value = V::pick(of_z, y.z, y.du);
    let slope = h * V::pick(of_z, k.dz, k.ddu);
    let positive = from.exceeds(h.like(0.0));
    Beyond {
        value: V::pick(positive, -value, value),
        slope: V::pick(positive, -slope, slope),
        bend: h.like(0.0),
    }
}
