//! A step of blocks that stand on bases that do not yield: no guard can happen, so that there is no search for a
//! root. The result is the same as that of a [`turn`](super::turn), at a lower cost.

use super::lanes::Lanes;
use super::rk4::rk4;
use super::state::is_finite;
use super::turn::select_motion;
use crate::model::dynamics::{Contact, rates};
use crate::model::isolation::support;
use crate::model::motion::Motion;
use crate::model::real::Vector;

impl<V: Vector> Lanes<'_, V> {
    /// Takes a step in every lane; all lanes must be between two steps under excitation. The result is the lanes
    /// whose cell has ended, one bit each.
    #[inline(never)]
    pub fn stand(&mut self) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.stand_lanes(),
        )
    }

    #[inline(always)]
    fn stand_lanes(&mut self) -> u64 {
        let variant = self.shared.variant;
        let (zero, one, half) = (self.start.like(0.0), self.start.like(1.0), self.start.like(0.5));
        let standing = zero.mask(0);
        let moved = zero.mask(self.running);
        let ground = self.ground(zero);
        let ground_mid = self.ground(half);
        let ground_end = self.ground(one);
        let h = self.forcing.step;
        let set = self.equations();
        let k1 = rates(&set, &self.corner, standing, &self.y, ground);
        let grounds = [ground_mid, ground_end];
        let mut stepped = rk4(&set, &self.corner, standing, &self.y, &k1, h, grounds);
        // These do not change here; so written, their arithmetic is left out.
        let Motion { u, du, z, phi, dphi, .. } = self.y;
        stepped.y = Motion { phi, dphi, ..stepped.y };
        if !variant.isolated_h {
            stepped.y = Motion { u, du, z, ..stepped.y };
        }
        let base = support(&set, &stepped.y, ground_end);
        let (asked, stands) = (set.variant.asked, (standing, self.corner.side));
        self.extremes.update_motion(asked, moved, stands, &self.y, &stepped.y, h);
        if let Some(direction) = self.spans.direction {
            let end = Contact { shear: base.f_h, normal: base.f_v };
            self.spans.take(direction, moved, [k1.contact(), stepped.mid, end]);
        }
        self.y = select_motion(moved, &stepped.y, &self.y);
        self.forcing.done = self.forcing.done + V::select(moved, one, zero);
        let lost = moved & !is_finite(&self.y);
        let left = self.end_gaps(moved);
        let ending = V::bits(lost | left) & self.running;
        if ending == 0 { 0 } else { self.end_segments_and_cells(ending, V::bits(lost), 0, 0) }
    }
}
