//! The turn: one Runge-Kutta trial of every lane, and how each lane uses the result of its trial. Twin of
//! `shaders/turn.wgsl`.
//!
//! A trial is a step, the rest of a step after a switch, or a step of a root search. Masks tell which, so
//! that no lane waits for another's switch. Every turn computes the rates at the start again: a switch
//! changes them, and needs no code of its own for that.

use crate::model::dynamics::{Contact, rates, uplift_moment};
use crate::model::excitation::Ground;
use crate::model::isolation::{stop_side, support};
use crate::model::motion::Motion;
use crate::model::real::{Real, Vector};

use super::certificate::STEPS_A_TRY;
use super::extremes::{Accelerations, stop_ends};
use super::guards::{EVENT_BOUND, GuardSample, KINK};
use super::lanes::Lanes;
use super::rk4::{rk4, shift_back};
use super::search::RootDistance;
use super::state::is_finite;

#[inline(always)]
pub(super) fn select_motion<V: Vector>(
    mask: V::Mask,
    yes: &Motion<V>,
    no: &Motion<V>,
) -> Motion<V> {
    yes.zip(no, |yes, no| V::select(mask, yes, no))
}

impl<V: Vector> Lanes<'_, V> {
    /// Updates the largest accelerations of the lanes that move on, by the second derivatives of u and v, the contact force and
    /// the ground at the start, the middle and the end of their spans.
    #[inline(always)]
    fn update_accelerations(
        &mut self,
        moved: V::Mask,
        instants: &[([V; 2], Contact<V>, Ground<V>); 3],
    ) {
        let set = self.equations();
        let [start, mid, end] = instants;
        let start = Accelerations::of(&set, start.0, start.1, start.2);
        let mid = Accelerations::of(&set, mid.0, mid.1, mid.2);
        let end = Accelerations::of(&set, end.0, end.1, end.2);
        self.extremes.update_accelerations(moved, [&start, &mid, &end]);
    }

    /// Updates the extremes of the contact forces of the lanes that move on, or what is wanted of each of their spans.
    #[inline(always)]
    fn feel(&mut self, moved: V::Mask, forces: [Contact<V>; 3]) {
        match self.spans.direction {
            Some(direction) => self.spans.take(direction, moved, forces),
            None => {
                let [start, mid, end] = forces;
                self.extremes.update_contact(moved, start, mid, end);
            }
        }
    }

    /// The lanes whose base is not against its end stop.
    #[inline(always)]
    fn is_apart(&self) -> V::Mask {
        self.start.like(0.0).ge(stop_side(&self.equations(), &self.y).abs())
    }

    /// Every lane makes its trial; the lanes whose cell has ended, a bit each.
    #[inline(always)]
    pub(super) fn turn(&mut self) -> u64 {
        let variant = self.shared.variant;
        let (zero, one, half) = (self.start.like(0.0), self.start.like(1.0), self.start.like(0.5));
        let none = zero.mask(0);
        let seeking = self.search.sought.any();
        let again = self.search.again;
        let begun = zero.mask(self.running) & !(seeking | again);
        let ground = self.forcing.ground(variant, &self.cell, self.start);
        if variant.stops {
            self.stop = stop_side(&self.equations(), &self.y);
        }
        let set = self.equations();
        let k1 = rates(&set, &self.corner, self.rocking, &self.y, ground);

        // The contact force at the start may already lift the block: such a lane only changes its phase.
        let mut lifts = none;
        let mut to_left = none;
        let standing = begun & !self.rocking;
        if V::any(standing) {
            let left = uplift_moment(&set, &self.model.left, k1.contact());
            let right = uplift_moment(&set, &self.model.right, k1.contact());
            lifts = standing & (left.gt(zero) | right.gt(zero));
            to_left = left.ge(right);
        }
        let whole = begun & !lifts;
        self.begin_spans(whole, &k1);

        // The trial.
        let mut length = self.search.at * self.span;
        let mut h = length * self.forcing.step;
        let ground_mid = self.forcing.ground(variant, &self.cell, self.start + half * length);
        let ground_end = self.forcing.ground(variant, &self.cell, self.start + length);
        let set = self.equations();
        let (corner, rocking) = (&self.corner, self.rocking);
        let stepped = rk4(&set, corner, rocking, &self.y, &k1, h, [ground_mid, ground_end]);
        let mut y1 = stepped.y;
        let mut k_end = stepped.k4;
        if V::any(!rocking) {
            // The contact force of full contact at the end, so that the time of an uplift is as exact as
            // the motion.
            let base = support(&set, &y1, ground_end);
            k_end.shear = V::select(rocking, k_end.shear, base.f_h);
            k_end.normal = V::select(rocking, k_end.normal, base.f_v);
        }

        // The distance to the guard that a lane searches for; without a search, to an impact before the end.
        let mut end = GuardSample { value: zero, slope: zero, bend: zero, rounding: zero };
        let mut reach = RootDistance::none(zero);
        let beyond = rocking & zero.gt(corner.side * y1.phi);
        if V::any(seeking | beyond) {
            let whole_h = self.span * self.forcing.step;
            end = self.sample(&y1, &k_end);
            reach = self.search.reach(&end, whole_h * whole_h * k1.ddphi);
        }

        // The result of the searches.
        let mut looked = whole;
        let mut kinked = none;
        let mut stopped = none;
        let mut arrived = none;
        let mut switched = none;
        let mut overturned = none;
        let mut back = zero;
        if V::any(seeking) {
            let sought = self.search.sought;
            let found = self.search.narrow(end, &reach);
            kinked = found.lanes & sought.kink();
            stopped = found.lanes & sought.stop;
            arrived = found.lanes & sought.uplift;
            switched = found.lanes & sought.angle();
            overturned = found.lanes & sought.overturning;
            back = found.back * self.span;
            // A kink and an uplift cut the step: the next turn goes on from there.
            self.span = V::select(kinked | arrived, length, self.span);
            self.cut = self.cut | kinked | arrived;
            looked = looked | kinked;
        }
        let mut crossing = self.crossing(looked, (kinked, stopped), &stepped, &k1, &k_end, h);
        // A span that was cut for an impact, and ends just beyond it, ends at the impact.
        let mut landed = none;
        if V::any(crossing.found.impact) {
            let allowed = one.like(V::Element::EVENT_TOLERANCE.to_f64());
            let impact = crossing.found.impact & !kinked & crossing.upper.ge(one);
            landed = impact & reach.steep & allowed.ge(reach.way.error);
            crossing.found.impact = crossing.found.impact & !landed;
            back = V::select(landed, reach.way.back * length, back);
            switched = switched | landed;
        }
        let found = crossing.found.any();
        if V::any(found) {
            self.search.begin(&crossing.found, &crossing.cubic, crossing.upper);
        }
        if V::any(switched) {
            let shifted = shift_back(&y1, &k1, &k_end, back * self.forcing.step, h);
            y1 = select_motion(switched, &shifted, &y1);
            length = length - back;
            h = length * self.forcing.step;
        }

        // The lanes whose cell moves on to the end of its trial.
        let plain = (looked & !(found | landed)) | again;
        self.search.again = self.search.again & !again;
        let moved = plain | switched | arrived;
        let rocks = (self.rocking, self.corner.side);
        self.extremes.update_motion(variant.asked, moved, rocks, &self.y, &y1, h);
        if variant.asked.forces {
            self.feel(moved, [k1.contact(), stepped.mid, k_end.contact()]);
        }
        if variant.asked.accelerations {
            let instants = [
                ([k1.ddu, k1.ddv], k1.contact(), ground),
                (stepped.mid_base, stepped.mid, ground_mid),
                ([k_end.ddu, k_end.ddv], k_end.contact(), ground_end),
            ];
            // In a function of its own: few runs ask for it, and its code would slow the others down.
            zero.with(|| self.update_accelerations(moved, &instants));
        }
        if variant.asked.stops {
            let set = self.equations();
            let ends = stop_ends(&set, (&self.y, &k1), (&y1, &k_end));
            let meets = zero.ge(self.stop.abs()) & stop_side(&set, &y1).abs().gt(zero);
            self.extremes.update_stop(moved, ends, h);
            self.extremes.add_stop_hits(moved & meets);
        }
        self.y = select_motion(moved, &y1, &self.y);
        self.start = V::select(moved, self.start + length, self.start);
        self.events = self.events + V::select(lifts, one, zero);
        let mut ended = 0;
        if V::any(lifts) {
            self.lift(V::bits(lifts) & self.running, V::bits(to_left));
        }
        let mut proved = none;
        if V::any(switched) {
            let mut apart = none;
            if variant.asked.stops {
                apart = switched & self.is_apart();
            }
            let others = self.bounce(switched & !overturned) & self.running;
            let over = V::bits(overturned) & self.running;
            if others | over != 0 {
                ended = self.settle(others, over);
            }
            if V::any(apart) {
                // An impact changes u', and with it the force of the stop's damper: the push may begin there.
                self.extremes.add_stop_hits(apart & !self.is_apart());
            }
            proved = switched;
        }
        let through = ((plain & !self.cut) | (moved & self.start.ge(one))) & !overturned;
        let between = moved & !through;
        if self.log.is_some() {
            // A step that is cut at a kink.
            self.tell_each(V::bits(between & !switched), KINK);
        }
        self.events = self.events + V::select(between, one, zero);
        let endless = self.events.ge(one.like(f64::from(EVENT_BOUND)));
        self.start = V::select(through, zero, self.start);
        self.events = V::select(through, zero, self.events);
        self.forcing.done = self.forcing.done + V::select(through, one, zero);
        let mut ending = V::bits(endless);
        if variant.certificate {
            self.steps_since_check = self.steps_since_check + V::select(through, one, zero);
            let due = through & self.steps_since_check.ge(one.like(f64::from(STEPS_A_TRY)));
            self.steps_since_check = V::select(due, zero, self.steps_since_check);
            proved = (proved | (due & !self.rocking)) & self.free();
            if V::any(proved) {
                let landed = proved & self.rocking;
                proved = self.is_final(proved);
                ending |= V::bits(proved);
                self.rest_early(landed & !proved);
            }
        }
        let lost = through & !is_finite(&self.y);
        let left = self.end_gaps(through);
        ending = (ending | V::bits(lost | left)) & self.running & !ended;
        if ending != 0 {
            ended |= self.end_segments_and_cells(
                ending,
                V::bits(lost),
                V::bits(endless),
                V::bits(proved),
            );
        }
        ended & self.running
    }
}
