//! The change of the phase at a switch: uplift, impact, rest, overturning, and the ends of segments and cells.
//! Impacts are computed for all lanes at once; the other switches, which are rare, one lane at a time. Twin of
//! `shaders/switching.wgsl`.

use crate::model::CellEquations;
use crate::model::block::{Corner, FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use crate::model::dynamics::{Contact, largest_uplift_moment};
use crate::model::impact::{change_corner, come_to_rest};
use crate::model::isolation::{stop_side, support};
use crate::model::real::{Real, Vector};

use super::certificate;
use super::early_rest::rests_early;
use super::guards::{IMPACT, OVERTURN, UPLIFT_LEFT, UPLIFT_RIGHT};
use super::lanes::{Lanes, each};
use super::state::{
    DIVERGED, EVENT_LIMIT, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, PROVED, RUNNING,
};
use super::turn::select_motion;

#[inline(always)]
fn select_corner<V: Vector>(mask: V::Mask, yes: &Corner<V>, no: &Corner<V>) -> Corner<V> {
    yes.zip(no, |yes, no| V::select(mask, yes, no))
}

impl<V: Vector> Lanes<'_, V> {
    /// The blocks of some lanes lift about the left or the right corner.
    #[inline(never)]
    pub(super) fn lift(&mut self, bits: u64, to_left: u64) {
        self.start.with(
            #[inline(always)]
            || self.lift_lanes(bits, to_left),
        )
    }

    #[inline(always)]
    fn lift_lanes(&mut self, bits: u64, to_left: u64) {
        for lane in each(bits) {
            let left = to_left >> lane & 1 == 1;
            let (step, fraction) = (self.step(lane), self.start.lane(lane));
            self.leave(lane);
            let state = &mut self.lanes[lane].job.state;
            if state.uplifts == 0 {
                state.uplift_step = step;
                state.uplift_fraction = fraction;
            }
            state.uplifts += 1;
            state.mode = if left { ROCKING_LEFT } else { ROCKING_RIGHT };
            self.lifted = self.lifted | self.start.mask(1 << lane);
            self.enter(lane);
            self.tell(lane, if left { UPLIFT_LEFT } else { UPLIFT_RIGHT });
        }
    }

    /// The blocks of the landing lanes turn about their other corner. Returns the lanes whose block may come to rest
    /// instead, one bit each.
    #[inline(always)]
    pub(super) fn bounce(&mut self, lands: V::Mask) -> u64 {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let to_right = self.corner.side.gt(zero);
        let landing = select_corner(to_right, &self.model.right, &self.model.left);
        let rebound = (landing.eta_phi * self.y.dphi).abs();
        let rebounds = rebound.ge(self.cell.steps.rest_speed) & landing.eta_phi.gt(zero);
        let bounces = lands & rebounds;
        self.y = select_motion(bounces, &change_corner(&landing, &self.y), &self.y);
        self.corner = select_corner(bounces, &landing, &self.corner);
        self.impacts = self.impacts + V::select(lands, one, zero);
        if self.log.is_some() {
            self.tell_each(V::bits(bounces), IMPACT);
        }
        V::bits(lands & !rebounds)
    }

    /// Blocks of slow lanes come to rest or continue to rock; blocks of other lanes overturn. Returns the lanes whose
    /// cell has ended.
    #[inline(never)]
    pub(super) fn settle(&mut self, slow: u64, over: u64) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.settle_lanes(slow, over),
        )
    }

    #[inline(always)]
    fn settle_lanes(&mut self, slow: u64, over: u64) -> u64 {
        for lane in each(slow) {
            self.leave(lane);
            self.land(lane);
            self.enter(lane);
            self.tell(lane, IMPACT);
        }
        for lane in each(over) {
            self.leave(lane);
            let fraction = self.start.lane(lane);
            let state = &mut self.lanes[lane].job.state;
            state.end_fraction = fraction;
            let left = state.mode == ROCKING_LEFT;
            state.status = if left { OVERTURNED_LEFT } else { OVERTURNED_RIGHT };
            self.tell(lane, OVERTURN);
        }
        over
    }

    /// A block that lands too slowly to lift again comes to rest on both corners, unless the contact force lifts it
    /// there. Where the law of impact gives no rebound (eta_phi <= 0) it always comes to rest.
    #[inline(always)]
    fn land(&mut self, lane: usize) {
        let zero = V::Element::of(0.0);
        let ground = self.forcing.ground(self.shared.variant, &self.cell, self.start);
        let ground = ground.map(|number| number.lane(lane));
        let job = &mut self.lanes[lane].job;
        let set = self.shared.equations(&job.cell);
        let state = &mut job.state;
        let leaving = pivot(set.model, state.mode);
        let other = if state.mode == ROCKING_RIGHT { ROCKING_LEFT } else { ROCKING_RIGHT };
        let landing = pivot(set.model, other);
        let resting = come_to_rest(&set, &leaving, &state.motion);
        let side = stop_side(&set, &resting);
        let set = CellEquations { stop: set.variant.stops.then_some(&side), ..set };
        let base = support(&set, &resting, ground);
        let contact = Contact { shear: base.f_h, normal: base.f_v };
        let lifts = largest_uplift_moment(&set, contact) > zero;
        if lifts && landing.eta_phi > zero {
            state.motion = change_corner(&landing, &state.motion);
            state.mode = other;
            return;
        }
        state.motion = resting;
        state.mode = FULL_CONTACT;
    }

    /// The lanes of `tried` whose results are final.
    #[inline(always)]
    pub(super) fn is_final(&self, tried: V::Mask) -> V::Mask {
        let set = self.equations();
        certificate::is_final(
            &set,
            &self.corner,
            self.rocking,
            tried,
            self.lifted,
            &self.y,
            &self.extremes,
        )
    }

    /// Blocks of `landed` lanes, which have just had an impact, come to rest where their later flights change no
    /// result.
    #[inline(always)]
    pub(super) fn rest_early(&mut self, landed: V::Mask) {
        if !V::any(landed) {
            return;
        }
        let set = self.equations();
        let rests = rests_early(&set, &self.corner, landed, &self.y, &self.extremes);
        let resting = come_to_rest(&set, &self.corner, &self.y);
        self.y = select_motion(rests, &resting, &self.y);
        self.rocking = self.rocking & !rests;
    }

    /// Ends forcing segments, and cells that are at their end, proved final, out of range, or have too many switches
    /// in a step. Returns the lanes whose cell ended.
    #[inline(never)]
    pub(super) fn end_segments_and_cells(
        &mut self,
        bits: u64,
        lost: u64,
        endless: u64,
        proved: u64,
    ) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.attend_lanes(bits, lost, endless, proved),
        )
    }

    #[inline(always)]
    fn attend_lanes(&mut self, bits: u64, lost: u64, endless: u64, proved: u64) -> u64 {
        let mut ended = 0;
        for lane in each(bits) {
            let bit = 1 << lane;
            let (step, fraction) = (self.step(lane), self.start.lane(lane));
            let job = &mut self.lanes[lane].job;
            if endless & bit != 0 {
                job.state.status = EVENT_LIMIT;
            } else if lost & bit != 0 {
                job.state.status = DIVERGED;
            } else if step >= job.cell.steps.steps {
                job.state.status = FINISHED;
            } else if proved & bit != 0 {
                job.state.end_fraction = fraction;
                job.state.status = PROVED;
            }
            if job.state.status != RUNNING {
                ended |= bit;
                continue;
            }
            self.begin_segment(lane, step, true);
        }
        ended
    }

    /// Tells the log that a switch has just happened in a lane.
    #[inline(always)]
    fn tell(&mut self, lane: usize, kind: u32) {
        if let Some(log) = &mut self.log {
            log.switched(kind, self.start.lane(lane), &self.lanes[lane].job.state);
        }
    }

    /// Tells the log of switches that have just happened in some lanes: of these the motion is not yet in the state.
    #[inline(never)]
    pub(super) fn tell_each(&mut self, bits: u64, kind: u32) {
        for lane in each(bits & self.running) {
            self.leave(lane);
            self.tell(lane, kind);
        }
    }
}
