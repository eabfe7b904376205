//! The largest and least values of each lane's cell so far. Twin of `shaders/extremes.wgsl`.

use bytemuck::Zeroable;

use crate::model::CellEquations;
use crate::model::asked::Asked;
use crate::model::dynamics::{Contact, Rates};
use crate::model::excitation::Ground;
use crate::model::isolation::{base_load, stop_force};
use crate::model::layout::{pod, reals};
use crate::model::motion::Motion;
use crate::model::number::Number;

use super::guards::crosses;
use super::rk4::hermite;

/// The largest and least values of a cell so far.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Extremes<R> {
    /// Largest phi while rocking about the left corner, rad.
    pub max_phi_left: R,
    /// Largest -phi while rocking about the right corner, rad.
    pub max_phi_right: R,
    /// Largest |u|, m.
    pub max_u: R,
    /// Least v from the static position, m: zero or below.
    pub least_v: R,
    /// Largest v from the static position, m: zero or above.
    pub most_v: R,
    /// Least normal contact force over M, m/s^2.
    pub min_contact: R,
    /// Largest |horizontal| / normal contact force while the latter is positive.
    pub friction: R,
    /// Largest horizontal acceleration of the upper plate, m/s^2.
    pub acc_plate: R,
    /// Largest horizontal acceleration of the centre of mass, m/s^2.
    pub acc_block: R,
    /// Largest acceleration of the upper plate with gravity, m/s^2.
    pub acc_plate_total: R,
    /// Largest acceleration of the centre of mass with gravity, m/s^2.
    pub acc_block_total: R,
    /// Largest vertical force that the base carries over M, m/s^2.
    pub base_load: R,
    /// Largest force of the end stop over M_t, m/s^2.
    pub stop_force: R,
    /// How often the end stop began to push the base.
    pub stop_hits: R,
}

pod!(Extremes, reals: 14, words: 0);
reals!(
    Extremes, 14, max_phi_left max_phi_right max_u least_v most_v min_contact friction acc_plate acc_block acc_plate_total
    acc_block_total base_load stop_force stop_hits
);

/// The most of t (1 - t)^2 in a span: what a cubic's slope at an end can add to its values.
const SLOPE_SHARE: f64 = 4.0 / 27.0;

/// The largest magnitude of a coordinate in some lanes: the larger of the one so far and that of a span,
/// its interior extremum included.
#[inline(always)]
pub fn peak<N: Number>(lanes: N::Mask, so_far: N, x0: N, rate0: N, x1: N, rate1: N, h: N) -> N {
    let ends = x0.abs().max(x1.abs());
    let most = N::select(lanes, so_far.max(ends), so_far);
    let bound = (h.like(SLOPE_SHARE) * h).mul_add(rate0.abs() + rate1.abs(), ends);
    let turns = lanes & crosses(rate0, rate1) & bound.gt(most);
    if !N::any(turns) {
        return most;
    }
    let at = rate0 / (rate0 - rate1);
    let extremum = hermite(x0, h * rate0, x1, h * rate1, at).abs();
    N::select(turns, most.max(extremum), most)
}

/// The least and the largest value of a coordinate in some lanes: those so far and those of a span, its
/// interior extremum included.
#[inline(always)]
pub fn range<N: Number>(
    lanes: N::Mask,
    [least, most]: [N; 2],
    x0: N,
    rate0: N,
    x1: N,
    rate1: N,
    h: N,
) -> [N; 2] {
    let (low, high) = (x0.min(x1), x0.max(x1));
    let least = N::select(lanes, least.min(low), least);
    let most = N::select(lanes, most.max(high), most);
    let beyond = h.like(SLOPE_SHARE) * h * (rate0.abs() + rate1.abs());
    let passes = (high + beyond).gt(most) | least.gt(low - beyond);
    let turns = lanes & crosses(rate0, rate1) & passes;
    if !N::any(turns) {
        return [least, most];
    }
    let at = rate0 / (rate0 - rate1);
    let extremum = hermite(x0, h * rate0, x1, h * rate1, at);
    [N::select(turns, least.min(extremum), least), N::select(turns, most.max(extremum), most)]
}

/// The slopes at both ends, over the whole span, of the parabola through its start, middle and end.
#[inline(always)]
pub fn end_slopes<N: Number>(start: N, mid: N, end: N) -> (N, N) {
    let (three, four) = (start.like(3.0), start.like(4.0));
    (four * mid - three * start - end, three * end - four * mid + start)
}

/// The extremum of the parabola through a span's start, middle and end, where it lies inside; else
/// the start.
#[inline(always)]
pub fn crest<N: Number>(start: N, mid: N, end: N) -> N {
    let half = start.like(0.5);
    let (rise, fall) = end_slopes(start, mid, end);
    let top = start + half * rise * rise / (rise - fall);
    N::select(crosses(rise, fall), top, start)
}

/// How far a parabola through three values can go beyond them: its extremum is at most a quarter of
/// the span from the nearest.
#[inline(always)]
pub fn bend<N: Number>(start: N, mid: N, end: N) -> N {
    mid.like(0.125) * (start - mid.like(2.0) * mid + end).abs()
}

/// The largest value of a quantity in some lanes: the larger of the one so far and that of the parabola through its values
/// at a span's start, middle and end.
#[inline(always)]
fn highest<N: Number>(lanes: N::Mask, so_far: N, start: N, mid: N, end: N) -> N {
    let most = start.max(mid).max(end).max(crest(start, mid, end));
    N::select(lanes, so_far.max(most), so_far)
}

/// Accelerations of the upper plate and of the block's centre of mass at an instant, and what the base carries, m/s^2.
#[derive(Debug, Clone, Copy)]
pub struct Accelerations<R> {
    /// Magnitude of the upper plate's horizontal acceleration.
    plate: R,
    /// The same of the centre of mass.
    block: R,
    /// Magnitude of the upper plate's acceleration with gravity: g at rest.
    plate_total: R,
    /// The same of the centre of mass: the contact force over M.
    block_total: R,
    /// Vertical force that the base carries over M: of the block and of the plates.
    load: R,
}

impl<N: Number> Accelerations<N> {
    /// Those that belong to second derivatives of u and v, to a contact force and to the ground's accelerations.
    #[inline(always)]
    pub fn of(
        set: &CellEquations<N>,
        [ddu, ddv]: [N; 2],
        contact: Contact<N>,
        ground: Ground<N>,
    ) -> Accelerations<N> {
        let plate_h = ddu + ground.h;
        let below = ground.v + set.model.gravity;
        let plate_v = ddv + below;
        Accelerations {
            plate: plate_h.abs(),
            block: contact.shear.abs(),
            plate_total: plate_h.mul_add(plate_h, plate_v * plate_v).sqrt(),
            block_total: contact
                .shear
                .mul_add(contact.shear, contact.normal * contact.normal)
                .sqrt(),
            load: base_load(set, contact.normal, plate_v, below),
        }
    }
}

/// The end stop's force over M_t at one end of a span, m/s^2, and its rate there; zero where the base is not against it.
#[inline(always)]
fn stop_end<N: Number>(set: &CellEquations<N>, y: &Motion<N>, k: &Rates<N>) -> [N; 2] {
    let (zero, cell) = (y.u.like(0.0), set.cell);
    let side = set.stop.copied().unwrap_or(zero);
    let on = side.abs().gt(zero);
    let force = stop_force(set, side, y);
    let rate =
        side * cell.horizontal.stop_damping.mul_add(k.ddu, cell.horizontal.stop_stiffness * y.du);
    [N::select(on, force, zero), N::select(on, rate, zero)]
}

/// The same at both ends.
#[inline(always)]
pub fn stop_ends<N: Number>(
    set: &CellEquations<N>,
    (y0, k0): (&Motion<N>, &Rates<N>),
    (y1, k1): (&Motion<N>, &Rates<N>),
) -> [[N; 2]; 2] {
    [stop_end(set, y0, k0), stop_end(set, y1, k1)]
}

#[inline(always)]
fn share<N: Number>(shear: N, normal: N) -> N {
    let zero = shear.like(0.0);
    N::select(normal.gt(zero), shear / normal, zero)
}

impl<N: Number> Extremes<N> {
    /// Updates those extremes of some lanes that are requested by their motion over spans of `h` seconds, about corners
    /// of this side where they rock.
    #[inline(always)]
    pub fn update_motion(
        &mut self,
        asked: Asked,
        lanes: N::Mask,
        (rocking, side): (N::Mask, N),
        y0: &Motion<N>,
        y1: &Motion<N>,
        h: N,
    ) {
        if asked.displacements {
            self.max_u = peak(lanes, self.max_u, y0.u, y0.du, y1.u, y1.du, h);
            let range_v = [self.least_v, self.most_v];
            [self.least_v, self.most_v] = range(lanes, range_v, y0.v, y0.dv, y1.v, y1.dv, h);
        }
        let rocks = lanes & rocking;
        if !(asked.angles && N::any(rocks)) {
            return;
        }
        let left = side.gt(h.like(0.0));
        let so_far = N::select(left, self.max_phi_left, self.max_phi_right);
        let angle = peak(rocks, so_far, y0.phi, y0.dphi, y1.phi, y1.dphi, h);
        self.max_phi_left = N::select(left, angle, self.max_phi_left);
        self.max_phi_right = N::select(left, self.max_phi_right, angle);
    }

    /// Updates the largest accelerations of some lanes, and what their base carries, by those at a span's start, middle and
    /// end.
    #[inline(always)]
    pub fn update_accelerations(
        &mut self,
        lanes: N::Mask,
        [start, mid, end]: [&Accelerations<N>; 3],
    ) {
        macro_rules! update {
            ($($most:ident $of:ident)*) => {
                $(self.$most = highest(lanes, self.$most, start.$of, mid.$of, end.$of);)*
            };
        }
        update!(
            acc_plate plate acc_block block acc_plate_total plate_total acc_block_total block_total base_load load
        );
    }

    /// Updates the largest force on the end stop of some lanes by that at the ends of a span of `h` seconds.
    #[inline(always)]
    pub fn update_stop(&mut self, lanes: N::Mask, ends: [[N; 2]; 2], h: N) {
        let [[force0, rate0], [force1, rate1]] = ends;
        self.stop_force = peak(lanes, self.stop_force, force0, rate0, force1, rate1, h);
    }

    /// Counts the lanes whose end stop has begun to push.
    #[inline(always)]
    pub fn add_stop_hits(&mut self, lanes: N::Mask) {
        let (zero, one) = (self.stop_hits.like(0.0), self.stop_hits.like(1.0));
        self.stop_hits = self.stop_hits + N::select(lanes, one, zero);
    }

    /// Updates the extremes of some lanes by the contact forces at a span's start, middle and end, and by
    /// the crests of the parabolas through them: an extremum between two steps counts.
    #[inline(always)]
    pub fn update_contact(
        &mut self,
        lanes: N::Mask,
        start: Contact<N>,
        mid: Contact<N>,
        end: Contact<N>,
    ) {
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
