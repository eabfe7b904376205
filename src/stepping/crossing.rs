//! The first guard that has happened in a span just taken. Twin of `shaders/crossing.wgsl`.

use crate::model::CellEquations;
use crate::model::dynamics::{Contact, Rates, largest_uplift_moment, uplift_moment};
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};

use super::cubic::Cubic;
use super::extremes::end_slopes;
use super::guards::{GuardSample, Sought, angle_guard, crosses, end_stop_guard, kink_guard};
use super::lanes::Lanes;
use super::rk4::{Stepped, hermite};

/// The lanes whose span has a guard that happens in it.
pub struct Crossing<V: Vector> {
    /// The guard of each lane.
    pub found: Sought<V>,
    /// The value of the guard over the span.
    pub cubic: Cubic<V>,
    /// The fraction of the span at which the guard has happened.
    pub upper: V,
}

/// The error of a parabola at a crest, as a share of its second difference: for a step of a 32nd of a period it is
/// (omega h/2)^2/24 = 4e-4.
const CREST_ERROR: f64 = 1.0e-3;

/// Bound on the rounding error of an uplift moment.
#[inline(always)]
fn moment_rounding<V: Vector>(set: &CellEquations<V>, contact: Contact<V>) -> V {
    let (model, rounding) = (set.model, contact.normal.like(V::Element::ROUNDING.to_f64()));
    let arm = model.left.arm.max(model.right.arm);
    rounding * (model.height * contact.shear.abs() + arm * contact.normal.abs())
}

/// An upper bound of the uplift moment in a span with these contact forces at its start, middle and end: a parabola
/// exceeds three of its values by at most an eighth of their second difference.
#[inline(always)]
fn highest_moment<N: Number>(
    set: &CellEquations<N>,
    start: Contact<N>,
    mid: Contact<N>,
    end: Contact<N>,
) -> N {
    let (two, share) = (mid.shear.like(2.0), mid.shear.like(0.125 + CREST_ERROR));
    let arm = set.model.left.arm.max(set.model.right.arm);
    let shear = (start.shear - two * mid.shear + end.shear).abs();
    let normal = (start.normal - two * mid.normal + end.normal).abs();
    let (first, second) = (largest_uplift_moment(set, start), largest_uplift_moment(set, mid));
    let values = first.max(second).max(largest_uplift_moment(set, end));
    share.mul_add(set.model.height.mul_add(shear, arm * normal), values)
}

/// The parabola through the values of an uplift moment at the start, the middle and the end of a span, and the place
/// in the span where the moment is, or may be, positive; the place is negative where there is none.
#[inline(always)]
fn moment_rises<N: Number>(start: N, mid: N, end: N) -> (Cubic<N>, N) {
    let (zero, one) = (start.like(0.0), start.like(1.0));
    // The slope falls from `rise` to `fall`.
    let (rise, fall) = end_slopes(start, mid, end);
    let half = start.like(0.5);
    let cubic = Cubic { c0: start, c1: rise, c2: half * (fall - rise), c3: zero };
    let mut at = -one;
    let inside = rise.gt(zero) & zero.gt(fall);
    if N::any(inside) {
        let top = rise / (rise - fall);
        let missed = start.like(0.25 * CREST_ERROR) * (fall - rise);
        let positive = (start + half * rise * top).gt(missed);
        at = N::select(inside & positive, top, at);
    }
    (cubic, N::select(end.gt(zero), one, at))
}

impl<V: Vector> Lanes<'_, V> {
    /// The first kink in the spans of the `looked` lanes, each of `h` seconds.
    #[inline(always)]
    pub(super) fn kinks(
        &self,
        crossing: &mut Crossing<V>,
        looked: V::Mask,
        y1: &Motion<V>,
        k1: &Rates<V>,
        k_end: &Rates<V>,
        h: V,
    ) {
        let y = &self.y;
        let of_z = looked & crosses(y.z, y1.z);
        let of_du = looked & crosses(y.du, y1.du);
        if !V::any(of_z | of_du) {
            return;
        }
        // Where both change sign, the one whose chord does so first.
        let z_first = (y.du * (y.z - y1.z)).abs().gt((y.z * (y.du - y1.du)).abs());
        crossing.found.kink_z = of_z & (!of_du | z_first);
        crossing.found.kink_u = of_du & !crossing.found.kink_z;
        let of_z = crossing.found.kink_z;
        let start = kink_guard(of_z, y, y, k1, h);
        let end = kink_guard(of_z, y, y1, k_end, h);
        let kinks = crossing.found.kink();
        crossing.cubic = Cubic::select(kinks, &Cubic::through(start, end), &crossing.cubic);
    }

    /// The place where the base meets its end stop or leaves it in the spans of the `looked` lanes: before a kink
    /// that is found in the span, or without a kink.
    #[inline(always)]
    pub(super) fn stops(
        &self,
        crossing: &mut Crossing<V>,
        looked: V::Mask,
        y1: &Motion<V>,
        k1: &Rates<V>,
        k_end: &Rates<V>,
        h: V,
    ) {
        let set = self.equations();
        let (zero, rounding) = (h.like(0.0), h.like(V::Element::ROUNDING.to_f64()));
        let end = end_stop_guard(&set, y1, k_end, h, rounding);
        let passes = looked & end.value.gt(zero);
        if !V::any(passes) {
            return;
        }
        let start = end_stop_guard(&set, &self.y, k1, h, rounding);
        // The chords decide, as for two kinks in a span; where no other guard is found, its cubic begins at -1 and is
        // constant.
        let kink = crossing.cubic;
        let kink_rise = kink.c1 + kink.c2 + kink.c3;
        let earlier =
            (start.value * kink_rise).abs().ge((kink.c0 * (end.value - start.value)).abs());
        let first = passes & !(crossing.found.kink() & earlier);
        crossing.found.kink_u = crossing.found.kink_u & !first;
        crossing.found.kink_z = crossing.found.kink_z & !first;
        crossing.found.stop = first;
        crossing.cubic = Cubic::select(first, &Cubic::through(start, end), &crossing.cubic);
    }

    /// The first impact or overturning in the spans of the `looked` lanes, whose blocks rock.
    #[inline(always)]
    pub(super) fn angles(
        &self,
        crossing: &mut Crossing<V>,
        looked: V::Mask,
        y1: &Motion<V>,
        k1: &Rates<V>,
        k_end: &Rates<V>,
        h: V,
    ) {
        let zero = h.like(0.0);
        let (y, corner) = (&self.y, &self.corner);
        let phi0 = corner.side * y.phi;
        let phi1 = corner.side * y1.phi;
        let dphi0 = corner.side * y.dphi;
        let dphi1 = corner.side * y1.dphi;
        let mut impact = zero.gt(phi1);
        let mut over = phi1.ge(corner.overturn);
        // Two crossings in one span: the extremum of the angle lies between them.
        let turns = looked & !(impact | over) & crosses(dphi0, dphi1);
        if V::any(turns) {
            let at = dphi0 / (dphi0 - dphi1);
            let extremum = hermite(phi0, h * dphi0, phi1, h * dphi1, at);
            let dips = turns & zero.gt(extremum);
            let peaks = turns & extremum.ge(corner.overturn);
            crossing.upper = V::select(dips | peaks, at, crossing.upper);
            impact = impact | dips;
            over = over | peaks;
        }
        crossing.found.impact = looked & impact;
        crossing.found.overturning = looked & over & !impact;
        let found = crossing.found.angle();
        if V::any(found) {
            let sense = V::select(impact, -corner.side, corner.side);
            let target = V::select(impact, zero, corner.overturn);
            let start = angle_guard(sense, target, y, k1, h);
            let end = angle_guard(sense, target, y1, k_end, h);
            crossing.cubic = Cubic::select(found, &Cubic::through(start, end), &crossing.cubic);
        }
    }

    /// The first uplift in the spans of the `looked` lanes, whose blocks stand.
    #[inline(always)]
    pub(super) fn uplifts(
        &self,
        crossing: &mut Crossing<V>,
        looked: V::Mask,
        start: Contact<V>,
        mid: Contact<V>,
        end: Contact<V>,
    ) {
        let set = self.equations();
        let zero = self.start.like(0.0);
        if !V::any(looked & highest_moment(&set, start, mid, end).gt(zero)) {
            return;
        }
        let (left, right) = (&self.model.left, &self.model.right);
        let (by_left, at_left) = moment_rises(
            uplift_moment(&set, left, start),
            uplift_moment(&set, left, mid),
            uplift_moment(&set, left, end),
        );
        let (by_right, at_right) = moment_rises(
            uplift_moment(&set, right, start),
            uplift_moment(&set, right, mid),
            uplift_moment(&set, right, end),
        );
        let (lefts, rights) = (at_left.gt(zero), at_right.gt(zero));
        let lifts = looked & (lefts | rights);
        crossing.found.uplift = lifts;
        if !V::any(lifts) {
            return;
        }
        // The first guess is for the moment that becomes positive first. The search itself uses the larger of the two
        // moments, whose zero is the first uplift in either case.
        let larger = uplift_moment(&set, left, end).ge(uplift_moment(&set, right, end));
        let earlier = at_right.gt(at_left) | (at_right.ge(at_left) & larger);
        let by_its_left = lefts & (!rights | earlier);
        let upper = V::select(by_its_left, at_left, at_right);
        crossing.upper = V::select(lifts, upper, crossing.upper);
        let cubic = Cubic::select(by_its_left, &by_left, &by_right);
        crossing.cubic = Cubic::select(lifts, &cubic, &crossing.cubic);
    }

    /// The first guard in the spans of the `looked` lanes, each of `h` seconds: a kink (except in the `kinked` lanes,
    /// whose span ends at one) or the end stop (except in the `stopped` lanes), else a switch.
    #[inline(always)]
    pub(super) fn crossing(
        &self,
        looked: V::Mask,
        (kinked, stopped): (V::Mask, V::Mask),
        stepped: &Stepped<V>,
        k1: &Rates<V>,
        k_end: &Rates<V>,
        h: V,
    ) -> Crossing<V> {
        let (zero, one) = (h.like(0.0), h.like(1.0));
        let mut crossing = Crossing {
            found: Sought::nothing(zero),
            cubic: Cubic { c0: -one, c1: zero, c2: zero, c3: zero },
            upper: one,
        };
        if self.shared.variant.kinks {
            self.kinks(&mut crossing, looked & !kinked, &stepped.y, k1, k_end, h);
            if self.shared.variant.stops {
                self.stops(&mut crossing, looked & !stopped, &stepped.y, k1, k_end, h);
            }
        }
        let looked = looked & !crossing.found.kink();
        let rocking = looked & self.rocking;
        if V::any(rocking) {
            self.angles(&mut crossing, rocking, &stepped.y, k1, k_end, h);
        }
        let standing = looked & !self.rocking;
        if V::any(standing) {
            self.uplifts(&mut crossing, standing, k1.contact(), stepped.mid, k_end.contact());
        }
        crossing
    }

    /// The guards at the ends of the trials: those that are searched for, or else impacts. Slopes are over the spans
    /// of the trials.
    #[inline(always)]
    pub(super) fn sample(&self, y1: &Motion<V>, k_end: &Rates<V>) -> GuardSample<V> {
        let set = self.equations();
        let h = self.span * self.forcing.step;
        let (corner, sought) = (&self.corner, &self.search.sought);
        let zero = h.like(0.0);
        let sense = V::select(sought.overturning, corner.side, -corner.side);
        let target = V::select(sought.overturning, corner.overturn, zero);
        let mut sample = angle_guard(sense, target, y1, k_end, h);
        let contact = k_end.contact();
        let moment = largest_uplift_moment(&set, contact);
        sample.value = V::select(sought.uplift, moment, sample.value);
        let rounding = moment_rounding(&set, contact);
        sample.rounding = V::select(sought.uplift, rounding, zero);
        let kink = kink_guard(sought.kink_z, &self.y, y1, k_end, h);
        sample.value = V::select(sought.kink(), kink.value, sample.value);
        sample.slope = V::select(sought.kink(), kink.slope, sample.slope);
        if self.shared.variant.stops {
            let rounding = h.like(V::Element::ROUNDING.to_f64());
            let stop = end_stop_guard(&set, y1, k_end, h, rounding);
            sample.value = V::select(sought.stop, stop.value, sample.value);
            sample.slope = V::select(sought.stop, stop.slope, sample.slope);
            sample.rounding = V::select(sought.stop, stop.rounding, sample.rounding);
        }
        sample
    }
}
