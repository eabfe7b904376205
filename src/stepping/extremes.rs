//! The largest and least values of each lane's cell so far. Twin of `shaders/extremes.wgsl`.

use crate::model::dynamics::{Contact, Motion};
use crate::model::number::Number;
use crate::model::real::reals;

use super::guards::crosses;
use super::rk4::hermite;

/// See [`State`](super::state::State), which holds the same of one cell.
#[derive(Debug, Clone, Copy)]
pub struct Extremes<R> {
    /// Largest phi while rocking about the left corner, rad.
    pub max_phi_left: R,
    /// Largest -phi while rocking about the right corner, rad.
    pub max_phi_right: R,
    /// Largest |u|, m.
    pub max_u: R,
    /// Largest |v|, m.
    pub max_v: R,
    /// Least normal contact force over M, m/s^2.
    pub min_contact: R,
    /// Largest |horizontal| / normal contact force while the latter is positive.
    pub friction: R,
}

reals!(Extremes, 6, max_phi_left max_phi_right max_u max_v min_contact friction);

/// Largest magnitude of a coordinate over a span, its interior extremum included.
#[inline(always)]
pub fn peak<N: Number>(x0: N, rate0: N, x1: N, rate1: N, h: N) -> N {
    let ends = x0.abs().max(x1.abs());
    let zero = h.like(0.0);
    let (rising0, rising1) = (rate0.gt(zero), rate1.gt(zero));
    let turns = (rising0 | rising1) & !(rising0 & rising1);
    if !N::any(turns) {
        return ends;
    }
    let at = rate0 / (rate0 - rate1);
    let extremum = hermite(x0, h * rate0, x1, h * rate1, at).abs();
    N::select(turns, ends.max(extremum), ends)
}

/// The extremum of the parabola through a span's start, middle and end, where it lies inside; else
/// the start.
#[inline(always)]
pub fn crest<N: Number>(start: N, mid: N, end: N) -> N {
    let (half, three, four) = (start.like(0.5), start.like(3.0), start.like(4.0));
    let rise = four * mid - three * start - end;
    let fall = three * end - four * mid + start;
    let top = start + half * rise * rise / (rise - fall);
    N::select(crosses(rise, fall), top, start)
}

/// How far a parabola through three values can go beyond them, at most four times that.
#[inline(always)]
fn bend<N: Number>(start: N, mid: N, end: N) -> N {
    (start - mid.like(2.0) * mid + end).abs()
}

impl<N: Number> Extremes<N> {
    /// Takes in the motion of some lanes over spans of `h` seconds about corners of this side.
    #[inline(always)]
    pub fn motion(&mut self, lanes: N::Mask, side: N, y0: &Motion<N>, y1: &Motion<N>, h: N) {
        let u = self.max_u.max(peak(y0.u, y0.du, y1.u, y1.du, h));
        self.max_u = N::select(lanes, u, self.max_u);
        let v = self.max_v.max(peak(y0.v, y0.dv, y1.v, y1.dv, h));
        self.max_v = N::select(lanes, v, self.max_v);
        let angle = peak(y0.phi, y0.dphi, y1.phi, y1.dphi, h);
        let left = side.gt(h.like(0.0));
        let larger = lanes & left & angle.gt(self.max_phi_left);
        self.max_phi_left = N::select(larger, angle, self.max_phi_left);
        let larger = lanes & !left & angle.gt(self.max_phi_right);
        self.max_phi_right = N::select(larger, angle, self.max_phi_right);
    }

    /// Takes in the contact forces of some lanes at a span's start, middle and end, and the crests of
    /// the parabolas through them: an extremum between two steps counts.
    #[inline(always)]
    pub fn contact(&mut self, lanes: N::Mask, start: Contact<N>, mid: Contact<N>, end: Contact<N>) {
        let zero = start.normal.like(0.0);
        let least = start.normal.min(mid.normal).min(end.normal);
        let lowest = least - bend(start.normal, mid.normal, end.normal);
        let lower = lanes & self.min_contact.gt(lowest);
        if N::any(lower) {
            let value = least.min(crest(start.normal, mid.normal, end.normal));
            let lower = lower & self.min_contact.gt(value);
            self.min_contact = N::select(lower, value, self.min_contact);
        }
        let shears = (start.shear.abs(), mid.shear.abs(), end.shear.abs());
        let most = shears.0.max(shears.1).max(shears.2) + bend(shears.0, shears.1, shears.2);
        let higher = lanes & most.gt(self.friction * lowest);
        if N::any(higher) {
            let share = |shear: N, normal: N| {
                let pressed = normal.gt(zero);
                N::select(pressed, shear / normal, zero)
            };
            let start = share(shears.0, start.normal);
            let mid = share(shears.1, mid.normal);
            let end = share(shears.2, end.normal);
            // Where the force turns tensile on the way there is no share at one of the three.
            let largest = start.max(mid).max(end);
            let top = largest.max(crest(start, mid, end));
            let value = N::select(least.gt(zero), top, largest);
            let higher = higher & value.gt(self.friction);
            self.friction = N::select(higher, value, self.friction);
        }
    }
}
