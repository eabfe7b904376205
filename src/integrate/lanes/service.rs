//! What is done a lane at a time: cells taken and given back, switches, legs, and proofs.

use crate::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use crate::model::dynamics::{Motion, rates, uplift_moment};
use crate::model::real::Real;
use crate::model::vector::Vector;

use super::super::certificate::{certify, is_due};
use super::super::state::{DIVERGED, EVENT_LIMIT, FINISHED, RUNNING, State, overturn};
use super::super::switching::{UPLIFT_LEFT, UPLIFT_RIGHT, land, lift};
use super::judge::pick_rates;
use super::{Feed, Job, Lanes, each};

/// Gives a lane's motion to its state.
#[inline(always)]
fn leave<V: Vector>(y: &Motion<V>, lane: usize, state: &mut State<V::Element>) {
    for (to, from) in state.motion.reals_mut().into_iter().zip(y.reals_ref()) {
        *to = from.lane(lane);
    }
}

impl<V: Vector> Lanes<'_, V> {
    /// Gives a lane the next cell that has anything left to run.
    #[inline(always)]
    pub(super) fn fill(&mut self, lane: usize, feed: &mut impl Feed<V::Element>) {
        while let Some(job) = feed.next() {
            if job.state.status != RUNNING {
                feed.done(&job);
                continue;
            }
            self.load(lane, job);
            return;
        }
        self.seek.stop(self.start.mask(1 << lane));
    }

    #[inline(always)]
    fn load(&mut self, lane: usize, job: Job<V::Element>) {
        let bit = self.start.mask(1 << lane);
        let zero = V::Element::of(0.0);
        self.running |= 1 << lane;
        for (to, from) in self.cell.reals_mut().into_iter().zip(job.cell.reals()) {
            to.put(lane, from);
        }
        self.seen.load(lane, &job.state);
        self.lanes[lane].job = job;
        self.enter(lane);
        self.begin_leg(lane, job.state.step);
        self.start.put(lane, zero);
        self.events.put(lane, zero);
        self.seek.at.put(lane, V::Element::of(1.0));
        self.seek.stop(bit);
        self.fresh = self.fresh | bit;
    }

    /// Takes a lane's motion and phase from its state.
    #[inline(always)]
    fn enter(&mut self, lane: usize) {
        let state = &self.lanes[lane].job.state;
        for (to, from) in self.y.reals_mut().into_iter().zip(state.motion.reals()) {
            to.put(lane, from);
        }
        let corner = pivot(self.shared.model, state.mode);
        for (to, from) in self.corner.reals_mut().into_iter().zip(corner.reals()) {
            to.put(lane, from);
        }
        let bit = self.start.mask(1 << lane);
        self.rocking = self.rocking & !bit;
        if state.mode != FULL_CONTACT {
            self.rocking = self.rocking | bit;
        }
    }

    /// Gives all that a lane knows to its state.
    #[inline(always)]
    pub(super) fn store(&mut self, lane: usize) {
        let state = &mut self.lanes[lane].job.state;
        leave(&self.y, lane, state);
        self.seen.store(lane, state);
    }

    #[inline(always)]
    fn begin_leg(&mut self, lane: usize, step: u32) {
        let one = &mut self.lanes[lane];
        let set = self.shared.setting(&one.job.cell);
        one.leg_start = self.leg.begin(lane, &set, step);
    }

    /// The step that a lane is in.
    #[inline(always)]
    fn step(&self, lane: usize) -> u32 {
        // A whole number of steps in a leg, below its most.
        self.lanes[lane].leg_start + self.leg.done.lane(lane).to_f64() as u32
    }

    /// The rates of lanes whose phase or ground has changed, and the uplifts that they call for at
    /// once.
    #[inline(never)]
    pub(super) fn refresh(&mut self) {
        self.start.with(
            #[inline(always)]
            || self.refresh_lanes(),
        )
    }

    #[inline(always)]
    fn refresh_lanes(&mut self) {
        let zero = self.start.like(0.0);
        let variant = self.shared.variant;
        loop {
            let fresh = self.fresh;
            let ground = self.leg.ground(variant.recorded, self.start);
            let set = self.equations();
            let k = rates(&set, &self.corner, self.rocking, &self.y, ground);
            let left = uplift_moment(&set, &self.model.left, k.shear, k.normal);
            let right = uplift_moment(&set, &self.model.right, k.shear, k.normal);
            self.k1 = pick_rates(fresh, &k, &self.k1);
            self.seen.contact(fresh, &k);
            let lifts = fresh & !self.rocking & (left.exceeds(zero) | right.exceeds(zero));
            let lefts = V::bits(left.exceeds(zero) & left.reaches(right));
            self.fresh = lifts;
            let bits = V::bits(lifts) & self.running;
            if bits == 0 {
                self.fresh = zero.mask(0);
                return;
            }
            for lane in each(bits) {
                let kind = if lefts >> lane & 1 == 1 { UPLIFT_LEFT } else { UPLIFT_RIGHT };
                let (step, fraction) = (self.step(lane), self.start.lane(lane));
                let state = &mut self.lanes[lane].job.state;
                leave(&self.y, lane, state);
                state.step = step;
                lift(state, kind, fraction);
                self.enter(lane);
            }
            self.events = self.events + V::pick(lifts, zero.like(1.0), zero);
        }
    }

    /// Counts an impact of some lanes; `to_right` of them go on about the right corner.
    #[inline(always)]
    pub(super) fn count_impacts(&mut self, bits: u64, to_right: u64) {
        for lane in each(bits) {
            let state = &mut self.lanes[lane].job.state;
            state.impacts += 1;
            state.mode = if to_right >> lane & 1 == 1 { ROCKING_RIGHT } else { ROCKING_LEFT };
        }
    }

    /// Switches the phase of lanes that have arrived where it does; those that have overturned.
    #[inline(never)]
    pub(super) fn switch(&mut self, bits: u64) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.switch_lanes(bits),
        )
    }

    #[inline(always)]
    fn switch_lanes(&mut self, bits: u64) -> u64 {
        let overturning = V::bits(self.overturning);
        let rocking = V::bits(self.rocking);
        let left = V::bits(self.left);
        let mut ended = 0;
        for lane in each(bits) {
            let bit = 1 << lane;
            let (step, fraction) = (self.step(lane), self.start.lane(lane));
            let Job { cell, state, .. } = &mut self.lanes[lane].job;
            leave(&self.y, lane, state);
            state.step = step;
            if rocking & bit == 0 {
                lift(state, if left & bit != 0 { UPLIFT_LEFT } else { UPLIFT_RIGHT }, fraction);
            } else {
                let corner = pivot(self.shared.model, state.mode);
                if overturning & bit != 0 {
                    overturn(state, &corner, fraction);
                    ended |= bit;
                } else {
                    land(&self.shared.setting(cell), state, &corner, fraction);
                }
            }
            self.enter(lane);
        }
        ended
    }

    /// Ends legs, and cells that are done, out of range, or switch without end; those that ended.
    #[inline(never)]
    pub(super) fn attend(&mut self, bits: u64, lost: u64, endless: u64) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.attend_lanes(bits, lost, endless),
        )
    }

    #[inline(always)]
    fn attend_lanes(&mut self, bits: u64, lost: u64, endless: u64) -> u64 {
        let mut ended = 0;
        for lane in each(bits) {
            let bit = 1 << lane;
            let step = self.step(lane);
            let Job { cell, state, .. } = &mut self.lanes[lane].job;
            state.step = step;
            if endless & bit != 0 {
                state.status = EVENT_LIMIT;
            } else if lost & bit != 0 {
                state.status = DIVERGED;
            } else if step >= cell.steps {
                state.status = FINISHED;
            }
            let set = self.shared.setting(cell);
            if state.status == RUNNING && is_due(&set, state) {
                leave(&self.y, lane, state);
                self.seen.store(lane, state);
                certify(&set, state);
            }
            if state.status != RUNNING {
                ended |= bit;
                continue;
            }
            if step == cell.steps_forced {
                self.fresh = self.fresh | self.start.mask(bit);
            }
            self.begin_leg(lane, step);
        }
        ended
    }
}
