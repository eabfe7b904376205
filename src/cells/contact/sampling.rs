//! Motions on the lanes of a vector, and the values that are kept of each gap between two samples.

use super::motions::{
    ACCELERATION, BOTTOM, DISPLACEMENT, LEAST, LEAST_SO_FAR, LOWER, LOWER_SO_FAR, MAGNITUDE,
    MAGNITUDE_SO_FAR, MINUS_LOWER_SO_FAR, TOP, UPPER, UPPER_SO_FAR, VELOCITY, Z,
};
use super::shared_motion::{MotionSet, SLACK};
use super::written_motions::{BEYOND, Row};
use crate::model::excitation::Cell;
use crate::model::real::Vector;
use crate::stepping::lanes::{Job, Lanes};
use crate::stepping::spans::Direction;
use crate::stepping::state::RUNNING;

/// Assigns each motion of a set to a lane.
#[inline(always)]
pub(crate) fn load<V: Vector>(lanes: &mut Lanes<V>, set: &MotionSet<V::Element>) {
    for (number, start) in set.starts.iter().enumerate() {
        let mut cell = Cell { body: number as u32, ..start.cell };
        cell.steps.steps = start.steps();
        if start.state.status == RUNNING && cell.steps.steps > 0 {
            lanes.load(number, Job { number, cell, state: start.state });
        }
    }
}

/// X or Y of each lane since the begin of its gap.
pub(crate) struct Gaps<V> {
    pub now: V,
    least: V,
    most: V,
    /// The largest change within a step.
    change: V,
    /// The largest upper bound, and the largest negative of the lower bound, of all gaps so far.
    upper_so_far: V,
    minus_lower_so_far: V,
    /// The largest |X|, or the least Y, of all gaps so far, crests between steps included.
    crest_so_far: V,
}

impl<V: Vector> Gaps<V> {
    /// The values at the start of the first gap. A block that lifts at once, at a jump, has no forces on record.
    #[inline(always)]
    pub fn at(now: V, direction: Direction) -> Gaps<V> {
        let [change, none] = [now.like(0.0), now.like(-BEYOND)];
        let [upper_so_far, minus_lower_so_far] = [none; 2];
        let crest_so_far = direction.no_crest(now);
        Gaps { now, least: now, most: now, change, upper_so_far, minus_lower_so_far, crest_so_far }
    }

    /// Some lanes have finished a step.
    #[inline(always)]
    pub fn take(&mut self, lanes: V::Mask, next: V) {
        self.change = V::select(lanes, self.change.max((next - self.now).abs()), self.change);
        self.least = V::select(lanes, self.least.min(next), self.least);
        self.most = V::select(lanes, self.most.max(next), self.most);
        self.now = V::select(lanes, next, self.now);
    }

    /// Some lanes begin their next gap.
    #[inline(always)]
    pub fn begin(&mut self, lanes: V::Mask) {
        self.least = V::select(lanes, self.now, self.least);
        self.most = V::select(lanes, self.now, self.most);
        self.change = V::select(lanes, self.change.like(0.0), self.change);
    }

    /// The gaps of some lanes end. The result is the row at the sample of each lane. The bounds of a gap allow for the
    /// values between the ends of steps.
    #[inline(always)]
    pub fn end(&mut self, over: V::Mask, lanes: &Lanes<V>, direction: Direction) -> Row<V> {
        let Gaps { least, most, change, now, .. } = *self;
        let slack = least.like(SLACK).mul_add(most.abs().max(least.abs()), change);
        let (lower, upper) = (least - slack, most + slack);
        let (above, below) = (self.upper_so_far, self.minus_lower_so_far);
        self.upper_so_far = V::select(over, above.max(upper), above);
        self.minus_lower_so_far = V::select(over, below.max(-lower), below);
        let (so_far, crest) = (self.crest_so_far, lanes.spans.crest);
        let mut row = [now.like(0.0); _];
        let (motion, extremes) = (lanes.motion(), lanes.extremes());
        (row[ACCELERATION], row[LOWER]) = (now, lower);
        match direction {
            Direction::Horizontal => {
                (row[DISPLACEMENT], row[VELOCITY], row[Z]) = (motion.u, motion.du, motion.z);
                (row[TOP], row[UPPER]) = (extremes.max_u, upper);
                row[UPPER_SO_FAR] = self.upper_so_far;
                row[MINUS_LOWER_SO_FAR] = self.minus_lower_so_far;
                self.crest_so_far = V::select(over, so_far.max(crest), so_far);
                (row[MAGNITUDE], row[MAGNITUDE_SO_FAR]) = (crest, self.crest_so_far);
            }
            Direction::Vertical => {
                (row[DISPLACEMENT], row[VELOCITY]) = (motion.v, motion.dv);
                (row[BOTTOM], row[TOP]) = (extremes.least_v, extremes.most_v);
                row[LOWER_SO_FAR] = -self.minus_lower_so_far;
                self.crest_so_far = V::select(over, so_far.min(crest), so_far);
                (row[LEAST], row[LEAST_SO_FAR]) = (crest, self.crest_so_far);
            }
        }
        row
    }
}
