//! What a span just taken holds: the first impact or overturning of a block that rocks, the first
//! uplift of one that stands. Twin of the scalar path's `find_crossing` and `find_uplift`.

use crate::model::dynamics::{Rates, uplift_moment};
use crate::model::vector::Vector;

use super::super::locate::crosses;
use super::super::rk4::{Stepped, hermite};
use super::Lanes;
use super::cubic::{Beyond, Cubic};

/// Lanes whose span holds a switch.
pub struct Crossing<V: Vector> {
    /// Those in which a block lands or overturns.
    pub turning: V::Mask,
    /// Those in which a block lifts.
    pub lifting: V::Mask,
    /// Of the turning ones, those in which it overturns.
    pub overturning: V::Mask,
    /// Of the lifting ones, those in which it lifts about the left corner.
    pub left: V::Mask,
    /// What the switch is the zero of, over the span.
    pub cubic: Cubic<V>,
    /// Where in the span it has happened.
    pub upper: V,
}

/// The parabola through an uplift moment's values at a span's start, middle and end, and where in
/// the span it is positive; negative where it is not.
#[inline(always)]
fn moment_rises<V: Vector>(start: V, mid: V, end: V) -> (Cubic<V>, V) {
    let (zero, one) = (start.like(0.0), start.like(1.0));
    let (three, four) = (start.like(3.0), start.like(4.0));
    // The slope falls from `rise` to `fall`.
    let rise = four * mid - three * start - end;
    let fall = three * end - four * mid + start;
    let half = start.like(0.5);
    let cubic = Cubic { c0: start, c1: rise, c2: half * (fall - rise), c3: zero };
    let mut at = -one;
    let inside = rise.exceeds(zero) & zero.exceeds(fall);
    if V::any(inside) {
        let top = rise / (rise - fall);
        let positive = (start + half * rise * top).exceeds(zero);
        at = V::pick(inside & positive, top, at);
    }
    (cubic, V::pick(end.exceeds(zero), one, at))
}

impl<V: Vector> Lanes<'_, V> {
    /// The first switch in the spans of `looked` lanes, each of `h` seconds.
    #[inline(always)]
    pub(super) fn crossing(
        &self,
        looked: V::Mask,
        stepped: &Stepped<V>,
        k_end: &Rates<V>,
        h: V,
    ) -> Crossing<V> {
        let (zero, one) = (h.like(0.0), h.like(1.0));
        let none = h.mask(0);
        let mut crossing = Crossing {
            turning: none,
            lifting: none,
            overturning: none,
            left: none,
            cubic: Cubic { c0: -one, c1: zero, c2: zero, c3: zero },
            upper: one,
        };
        let rocking = looked & self.rocking;
        if V::any(rocking) {
            let (y, y1, corner) = (&self.y, &stepped.y, &self.corner);
            let phi0 = corner.side * y.phi;
            let phi1 = corner.side * y1.phi;
            let dphi0 = corner.side * y.dphi;
            let dphi1 = corner.side * y1.dphi;
            let mut impact = zero.exceeds(phi1);
            let mut over = phi1.reaches(corner.overturn);
            // Two crossings in one span: the angle's extremum inside it.
            let turns = rocking & !(impact | over) & crosses(dphi0, dphi1);
            if V::any(turns) {
                let at = dphi0 / (dphi0 - dphi1);
                let extremum = hermite(phi0, h * dphi0, phi1, h * dphi1, at);
                let dips = turns & zero.exceeds(extremum);
                let peaks = turns & extremum.reaches(corner.overturn);
                crossing.upper = V::pick(dips | peaks, at, one);
                impact = impact | dips;
                over = over | peaks;
            }
            crossing.turning = rocking & (impact | over);
            if V::any(crossing.turning) {
                crossing.overturning = crossing.turning & !impact;
                let sense = V::pick(crossing.overturning, one, -one);
                let target = V::pick(crossing.overturning, corner.overturn, zero);
                let of = |phi: V, dphi: V| Beyond {
                    value: sense * phi - target,
                    slope: h * sense * dphi,
                    bend: zero,
                };
                let (start, end) = (of(phi0, dphi0), of(phi1, dphi1));
                crossing.cubic = Cubic::through(start, end);
            }
        }
        let standing = looked & !self.rocking;
        if V::any(standing) {
            let set = self.equations();
            let (left, right) = (&self.model.left, &self.model.right);
            let k1 = &self.k1;
            let (shear, normal) = (stepped.shear_mid, stepped.normal_mid);
            let left0 = uplift_moment(&set, left, k1.shear, k1.normal);
            let left1 = uplift_moment(&set, left, k_end.shear, k_end.normal);
            let right0 = uplift_moment(&set, right, k1.shear, k1.normal);
            let right1 = uplift_moment(&set, right, k_end.shear, k_end.normal);
            let (by_left, at_left) =
                moment_rises(left0, uplift_moment(&set, left, shear, normal), left1);
            let (by_right, at_right) =
                moment_rises(right0, uplift_moment(&set, right, shear, normal), right1);
            let (lefts, rights) = (at_left.exceeds(zero), at_right.exceeds(zero));
            crossing.lifting = standing & (lefts | rights);
            if V::any(crossing.lifting) {
                // Both hold at the end: the one whose chord rises through zero first.
                let both = left1.exceeds(zero) & right1.exceeds(zero);
                let chord = (left0 / (left0 - left1)).exceeds(right0 / (right0 - right1));
                let earlier = at_left.exceeds(at_right);
                let right_first = (both & chord) | (!both & earlier);
                let left = lefts & !(rights & right_first);
                crossing.left = crossing.lifting & left;
                let upper = V::pick(left, at_left, at_right);
                crossing.upper = V::pick(crossing.lifting, upper, crossing.upper);
                let cubic = Cubic::pick(left, &by_left, &by_right);
                crossing.cubic = Cubic::pick(crossing.lifting, &cubic, &crossing.cubic);
            }
        }
        crossing
    }
}
