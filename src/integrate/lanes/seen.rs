//! What the lanes have seen: twin of the observers of [`state`](super::super::state).

use crate::model::dynamics::{Motion, Rates};
use crate::model::vector::Vector;

use super::super::state::{State, peak};

/// The largest and least values of each lane's cell so far; see [`State`].
pub struct Seen<V> {
    max_phi_left: V,
    max_phi_right: V,
    max_u: V,
    max_v: V,
    min_contact: V,
    friction: V,
}

impl<V: Vector> Seen<V> {
    /// Nothing in any lane.
    #[inline(always)]
    pub fn new(zero: V) -> Seen<V> {
        Seen {
            max_phi_left: zero,
            max_phi_right: zero,
            max_u: zero,
            max_v: zero,
            min_contact: zero,
            friction: zero,
        }
    }

    /// Takes over what a cell has seen before.
    #[inline(always)]
    pub fn load(&mut self, lane: usize, state: &State<V::Element>) {
        self.max_phi_left.put(lane, state.max_phi_left);
        self.max_phi_right.put(lane, state.max_phi_right);
        self.max_u.put(lane, state.max_u);
        self.max_v.put(lane, state.max_v);
        self.min_contact.put(lane, state.min_contact);
        self.friction.put(lane, state.friction);
    }

    /// Gives it back.
    #[inline(always)]
    pub fn store(&self, lane: usize, state: &mut State<V::Element>) {
        state.max_phi_left = self.max_phi_left.lane(lane);
        state.max_phi_right = self.max_phi_right.lane(lane);
        state.max_u = self.max_u.lane(lane);
        state.max_v = self.max_v.lane(lane);
        state.min_contact = self.min_contact.lane(lane);
        state.friction = self.friction.lane(lane);
    }

    /// Takes in the motion of some lanes over spans of `h` seconds about corners of this side.
    #[inline(always)]
    pub fn motion(&mut self, lanes: V::Mask, side: V, y0: &Motion<V>, y1: &Motion<V>, h: V) {
        let u = self.max_u.max(peak(y0.u, y0.du, y1.u, y1.du, h));
        self.max_u = V::pick(lanes, u, self.max_u);
        let v = self.max_v.max(peak(y0.v, y0.dv, y1.v, y1.dv, h));
        self.max_v = V::pick(lanes, v, self.max_v);
        let angle = peak(y0.phi, y0.dphi, y1.phi, y1.dphi, h);
        let left = side.exceeds(h.like(0.0));
        let larger = lanes & left & angle.exceeds(self.max_phi_left);
        self.max_phi_left = V::pick(larger, angle, self.max_phi_left);
        let larger = lanes & !left & angle.exceeds(self.max_phi_right);
        self.max_phi_right = V::pick(larger, angle, self.max_phi_right);
    }

    /// Takes in the contact forces of some lanes.
    #[inline(always)]
    pub fn contact(&mut self, lanes: V::Mask, k: &Rates<V>) {
        let less = lanes & self.min_contact.exceeds(k.normal);
        self.min_contact = V::pick(less, k.normal, self.min_contact);
        let shear = k.shear.abs();
        let pressed = k.normal.exceeds(shear.like(0.0));
        let more = lanes & pressed & shear.exceeds(self.friction * k.normal);
        if V::any(more) {
            self.friction = V::pick(more, shear / k.normal, self.friction);
        }
    }
}
