//! A turn: a trial of every lane, and what each made of it. The same decisions as in
//! [`advance`](super::super::switching::advance), which takes one cell over one step.

use crate::model::block::Corner;
use crate::model::dynamics::{Motion, Rates, rates};
use crate::model::impact::change_corner;
use crate::model::real::Real;
use crate::model::vector::Vector;

use super::super::locate::crosses;
use super::super::rk4::{Stepped, rk4, shift};
use super::super::state::is_sound;
use super::super::switching::{EVENT_BOUND, YIELD_LIMIT};
use super::Lanes;
use super::cubic::{Beyond, Cubic};
use super::seek::of_kink;

/// Share of itself by which a span is longer than the way to the impact that it is cut for, so that
/// the impact is in it: what the rates leave out is mostly less.
const BEYOND: f64 = 5.0e-4;

#[inline(always)]
fn pick_motion<V: Vector>(mask: V::Mask, yes: &Motion<V>, no: &Motion<V>) -> Motion<V> {
    yes.zip(no, |yes, no| V::pick(mask, yes, no))
}

#[inline(always)]
pub(super) fn pick_rates<V: Vector>(mask: V::Mask, yes: &Rates<V>, no: &Rates<V>) -> Rates<V> {
    yes.zip(no, |yes, no| V::pick(mask, yes, no))
}

#[inline(always)]
fn pick_corner<V: Vector>(mask: V::Mask, yes: &Corner<V>, no: &Corner<V>) -> Corner<V> {
    yes.zip(no, |yes, no| V::pick(mask, yes, no))
}

impl<V: Vector> Lanes<'_, V> {
    /// Every lane makes its trial; the lanes whose cell has ended, a bit each.
    #[inline(always)]
    pub(super) fn turn(&mut self) -> u64 {
        if V::any(self.fresh) {
            self.refresh();
        }
        let variant = self.shared.variant;
        let (zero, one, half) = (self.start.like(0.0), self.start.like(1.0), self.start.like(0.5));
        let whole = self.start.mask(self.running) & !(self.seek.seeking() | self.seek.again);
        self.begin_spans(whole);
        let mut length = self.seek.at * self.span;
        let mut h = length * self.leg.step;
        let ground_mid = self.leg.ground(variant.recorded, self.start + half * length);
        let ground_end = self.leg.ground(variant.recorded, self.start + length);
        let set = self.equations();
        let (corner, rocking) = (&self.corner, self.rocking);
        let stepped = rk4(&set, corner, rocking, &self.y, &self.k1, h, [ground_mid, ground_end]);
        let mut y1 = stepped.y;
        let mut k_end = rates(&set, corner, rocking, &y1, ground_end);

        // What the lanes that seek have found.
        let again = self.seek.again;
        let mut looked = whole;
        let mut switched = zero.mask(0);
        let mut back = zero;
        let seeking = self.seek.seeking();
        if V::any(seeking) {
            let found = self.beyond(&stepped, &k_end);
            let kinking = self.seek.kinking;
            let arrived = self.seek.narrow(found);
            let kinked = arrived.lanes & kinking;
            switched = arrived.lanes & !kinking;
            back = arrived.back * self.span;
            self.span = V::pick(kinked, length, self.span);
            self.cut = self.cut | kinked;
            looked = looked | kinked;
        }
        // Where a kink or a switch lies in a span just taken.
        let mut kinks = zero.mask(0);
        if variant.kinks {
            let of_z = crosses(self.y.z, y1.z);
            let of_du = crosses(self.y.du, y1.du);
            kinks = whole & (of_z | of_du);
            // Where both cross, the one whose chord does so first.
            let z_first = (self.y.du / (self.y.du - y1.du)).exceeds(self.y.z / (self.y.z - y1.z));
            self.of_z = (self.of_z & !kinks) | (kinks & of_z & (!of_du | z_first));
            looked = looked & !kinks;
        }
        let mut crossing = self.crossing(looked, &stepped, &k_end, h);
        // Spans that end just beyond the impact that they were cut for end there.
        let change = -y1.phi / (h * y1.dphi);
        let missed = half * change * change * (h * h * k_end.ddphi).abs();
        let allowed = (h * y1.dphi).abs() * one.like(V::Element::EVENT_TOLERANCE.to_f64());
        let impact = crossing.turning & !crossing.overturning & crossing.upper.reaches(one);
        let landed = impact & allowed.reaches(missed);
        crossing.turning = crossing.turning & !landed;
        self.overturning = self.overturning & !landed;
        back = V::pick(landed, -change * length, back);
        switched = switched | landed;
        let crossed = crossing.turning | crossing.lifting;
        if V::any(kinks | crossed) {
            let mut cubic = crossing.cubic;
            if V::any(kinks) {
                let start = of_kink(self.of_z, &self.y, &self.y, &self.k1, h);
                let end = of_kink(self.of_z, &self.y, &y1, &k_end, h);
                cubic = Cubic::pick(kinks, &Cubic::through(start, end), &cubic);
            }
            self.seek.kinking = self.seek.kinking | kinks;
            self.seek.turning = self.seek.turning | crossing.turning;
            self.seek.lifting = self.seek.lifting | crossing.lifting;
            self.overturning = (self.overturning & !crossed) | crossing.overturning;
            self.left = (self.left & !crossed) | crossing.left;
            let upper = V::pick(crossed, crossing.upper, one);
            self.seek.begin(kinks | crossed, &cubic, upper);
        }

        if V::any(switched) {
            y1 = shift(&y1, &k_end, -back * self.leg.step);
            // The contact forces go back along their chord.
            let share = V::pick(back.abs().exceeds(zero), back / length, zero);
            k_end.normal = share.times_plus(self.k1.normal - k_end.normal, k_end.normal);
            k_end.shear = share.times_plus(self.k1.shear - k_end.shear, k_end.shear);
            length = length - back;
            h = length * self.leg.step;
        }

        // The lanes that move on.
        let plain = (looked & !(crossed | landed)) | again;
        self.seek.again = self.seek.again & !again;
        let moved = plain | switched;
        self.seen.motion(moved, self.corner.side, &self.y, &y1, h);
        self.seen.contact(moved, &k_end);
        self.y = pick_motion(moved, &y1, &self.y);
        self.k1 = pick_rates(plain, &k_end, &self.k1);
        self.start = V::pick(moved, self.start + length, self.start);
        let mut ended = 0;
        if V::any(switched) {
            let others = self.bounce(switched);
            if others != 0 {
                ended = self.switch(others);
            }
        }
        let through = (plain & !self.cut) | (moved & self.start.reaches(one));
        self.events = self.events + V::pick(moved & !through, one, zero);
        let endless = self.events.reaches(one.like(f64::from(EVENT_BOUND)));
        self.start = V::pick(through, zero, self.start);
        self.events = V::pick(through, zero, self.events);
        self.leg.done = self.leg.done + V::pick(through, one, zero);
        let sound = is_sound(&self.y);
        let left = through & self.leg.done.reaches(self.leg.steps);
        let attend =
            (V::bits((through & !sound) | left) | V::bits(endless)) & self.running & !ended;
        if attend != 0 {
            let lost = V::bits(through & !sound);
            ended |= self.attend(attend, lost, V::bits(endless));
        }
        ended & self.running
    }

    /// The blocks that have just landed go on about their other corner; the lanes whose switch is
    /// another, or that may come to rest, a bit each.
    #[inline(always)]
    fn bounce(&mut self, switched: V::Mask) -> u64 {
        let zero = self.start.like(0.0);
        self.fresh = self.fresh | switched;
        let to_right = self.corner.side.exceeds(zero);
        let landing = pick_corner(to_right, &self.model.right, &self.model.left);
        let rebound = (landing.eta_phi * self.y.dphi).abs();
        let lively = rebound.reaches(self.cell.rest_speed) & landing.eta_phi.exceeds(zero);
        let bounces = switched & self.rocking & !self.overturning & lively;
        self.y = pick_motion(bounces, &change_corner(&landing, &self.y), &self.y);
        self.corner = pick_corner(bounces, &landing, &self.corner);
        let bouncing = V::bits(bounces);
        self.count_impacts(bouncing, V::bits(to_right));
        V::bits(switched) & !bouncing
    }

    /// Spans begin. Where z would settle by more than the method bears they end early, and where the
    /// block is about to land they end there, as near as its rates tell.
    #[inline(always)]
    fn begin_spans(&mut self, whole: V::Mask) {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let rest = one - self.start;
        self.span = V::pick(whole, rest, self.span);
        self.cut = self.cut & !whole;
        if self.shared.variant.kinks {
            let n = one.like(f64::from(self.shared.variant.bouc_wen_n));
            let settling = n * self.y.du.abs() * self.cell.inverse_yield * self.leg.step;
            let limit = one.like(YIELD_LIMIT);
            let long = whole & (settling * rest).exceeds(limit);
            if V::any(long) {
                self.span = V::pick(long, limit / settling, self.span);
                self.cut = self.cut | long;
            }
        }
        // phi + d s + a s^2/2 after the fraction s of a step.
        let (half, two) = (one.like(0.5), one.like(2.0));
        let (side, step) = (self.corner.side, self.leg.step);
        let phi = side * self.y.phi;
        let d = side * self.y.dphi * step;
        let a = side * self.k1.ddphi * step * step;
        let end = self.span.times_plus((half * a).times_plus(self.span, d), phi);
        let lands = whole & self.rocking & zero.exceeds(end);
        if V::any(lands) {
            let root = (d * d - two * a * phi).max(zero).sqrt();
            let falls = zero.exceeds(d);
            let at = V::pick(falls, two * phi, -(d + root)) / V::pick(falls, root - d, a);
            let at = at * one.like(1.0 + BEYOND);
            let lands = lands & at.exceeds(zero) & self.span.exceeds(at);
            self.span = V::pick(lands, at, self.span);
            self.cut = self.cut | lands;
        }
    }

    /// What the trials of lanes that seek came to.
    #[inline(always)]
    fn beyond(&self, stepped: &Stepped<V>, k_end: &Rates<V>) -> Beyond<V> {
        let y1 = &stepped.y;
        let h = self.span * self.leg.step;
        let (corner, seek) = (&self.corner, &self.seek);
        let side = V::pick(self.overturning, corner.side, -corner.side);
        let target = V::pick(self.overturning, corner.overturn, h.like(0.0));
        let value = side * y1.phi - target;
        let angle = Beyond { value, slope: h * side * y1.dphi, bend: h * h * k_end.ddphi };
        let arm = V::pick(self.left, self.model.left.arm, self.model.right.arm);
        let push = self.model.height * k_end.shear;
        let moment = V::pick(self.left, push, -push) - arm * k_end.normal;
        let kink = of_kink(self.of_z, &self.y, y1, k_end, h);
        let value = V::pick(seek.lifting, moment, angle.value);
        Beyond {
            value: V::pick(seek.kinking, kink.value, value),
            slope: V::pick(seek.kinking, kink.slope, angle.slope),
            bend: angle.bend,
        }
    }
}
