//! The certificate: the proof, by energy, that all results of a cell are final. Twin of
//! `shaders/certificate.wgsl`.
//!
//! Once the excitation is over the system is passive: (9) and (11) only take energy out, and so does
//! an impact (15). The energy that is left bounds every coordinate and both contact forces from then
//! on. Where no bound lies beyond the extremes of the cell so far, its outcome and its largest and
//! least values are final, and it ends. A bound on what nobody asks for is not looked at.
//!
//! The bounds on the contact forces follow from (9) with f_h and f_v of (10), w = phi'^2,
//! kappa = 1 - mu and D = rho^2 + kappa_h P^2 + kappa_v Q^2:
//!
//! ```text
//! N = f_v (1 - kappa_v Q^2/D) - kappa_v P w [1 - (mu_h - mu_v) Q^2/D] + kappa_v (P Q/D) f_h
//! S = f_h (1 - kappa_h P^2/D) - kappa_h Q w [1 + (mu_h - mu_v) P^2/D] + kappa_h (P Q/D) f_v
//! ```
//!
//! with H <= P <= R, 0 <= Q <= b and w <= 2 E/D for an energy E over M.
//!
//! An end stop only pushes and takes energy, so that the system stays passive; its force is in none of these bounds,
//! which are looked at once what energy is left cannot reach it. A vertical spring that hardens stores
//! omega_v^2 v^2 (1 + (v/v_c)^2/2)/2 over M_v, which bounds |v| as the linear spring does; its force is at most
//! 1 + (v/v_c)^2 times the linear one's. A pendulum whose force follows the pressure is not passive: its cells run to
//! their end. The accelerations of a block that rocks have no bound here.

use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::isolation::base_load;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};

use super::extremes::Extremes;

/// Steps from one try of a block in full contact to the next. One that rocks is tried at its
/// impacts.
pub const STEPS_A_TRY: u32 = 16;
/// Share by which a bound on an energy must hold: far more than its rounding, also where the
/// energy is a small difference from that of rest. A bound on a contact force may pass the
/// extreme so far by this share of it.
pub const MARGIN: f64 = 1.0e-3;

/// P - H, the height that the centre of mass has gained at an angle phi >= 0 about a corner, m: no less
/// than this, by sin phi >= phi - phi^3/6 and 1 - cos phi <= phi^2/2 - phi^4/24 + phi^6/720.
#[inline(always)]
fn least_rise<N: Number>(set: &CellEquations<N>, corner: &Corner<N>, phi: N) -> N {
    let (one, half, t) = (phi.like(1.0), phi.like(0.5), phi * phi);
    let arm = corner.arm * (one - t * t.like(1.0 / 6.0));
    let height = set.model.height * (one - t * t.like(1.0 / 12.0) * (one - t * t.like(1.0 / 30.0)));
    phi * (arm - half * phi * height)
}

/// Twice the energies of the base over M_t, from rest.
#[inline(always)]
pub(super) fn base_energy_h<N: Number>(set: &CellEquations<N>, y: &Motion<N>) -> N {
    let (variant, cell) = (set.variant, set.cell);
    if !variant.isolated_h {
        return y.u.like(0.0);
    }
    let base_h = y.du * y.du + cell.horizontal.post_yield * y.u * y.u;
    if variant.yields {
        return base_h + cell.horizontal.yield_energy * y.z * y.z;
    }
    base_h
}

/// Twice those over M_v; gravity is in them.
#[inline(always)]
pub(super) fn base_energy_v<N: Number>(set: &CellEquations<N>, y: &Motion<N>) -> N {
    if !set.variant.isolated_v {
        return y.u.like(0.0);
    }
    let square = y.v * y.v;
    let linear = y.dv * y.dv + set.cell.vertical.stiffness_v * square;
    if set.variant.hardens {
        return linear + y.v.like(0.5) * set.cell.vertical.hardening_v * square * square;
    }
    linear
}

/// The most of |X|, in full contact, for twice an energy over M_t that is left to it, by Cauchy's inequality.
#[inline(always)]
pub(super) fn most_x<N: Number>(set: &CellEquations<N>, root_h: N) -> N {
    set.cell.horizontal.reach_h * root_h
}

/// The same of |Y - g|; `root_v` is the root of twice an energy over M_v.
#[inline(always)]
pub(super) fn most_y<N: Number>(set: &CellEquations<N>, root_v: N) -> N {
    let swing = set.cell.vertical.reach_v * root_v;
    if set.variant.hardens {
        let ratio = root_v / set.cell.vertical.stiffness_v;
        return swing * (set.cell.vertical.hardening_v * ratio).mul_add(ratio, root_v.like(1.0));
    }
    swing
}

/// The lanes of `tried` in which energies that are left in the base reach no further than the largest |u| and |v|, or in
/// which nobody asks for these. Like
/// all that is called from a turn it is a function: a closure that is called twice is compiled by itself, without the
/// instructions of the vectors.
#[inline(always)]
pub(super) fn within<V: Vector>(
    set: &CellEquations<V>,
    extremes: &Extremes<V>,
    tried: V::Mask,
    left_h: V,
    left_v: V,
) -> V::Mask {
    let (variant, cell) = (set.variant, set.cell);
    let two = left_h.like(2.0);
    let mut within = tried;
    if variant.stops {
        // The end stop is out of reach.
        within = within
            & (cell.horizontal.post_yield * cell.horizontal.stop_gap * cell.horizontal.stop_gap)
                .ge(left_h);
    }
    if !variant.asked.displacements {
        return within;
    }
    if variant.isolated_h {
        within = within & (cell.horizontal.post_yield * extremes.max_u * extremes.max_u).ge(left_h);
    }
    if variant.isolated_v {
        // A base at rest moves by the rounding error of the weight that it carries. With the deflection
        // |v| is largest below, or, of a swing of twice the deflection and more, above.
        let rounding_allowance =
            left_v.like(V::Element::EVENT_TOLERANCE.to_f64()) * cell.vertical.deflection;
        let way = (-extremes.least_v).max(extremes.most_v - two * cell.vertical.deflection)
            + rounding_allowance;
        within = within & (cell.vertical.stiffness_v * way * way).ge(left_v);
    }
    within
}

/// The lanes of `tried` of which everything that is requested is final, the excitation being over; a block of theirs
/// that rocks has just had an impact. `lifted` are those that have lifted from full contact, whose time of first uplift is known.
#[inline(always)]
pub fn is_final<V: Vector>(
    set: &CellEquations<V>,
    corner: &Corner<V>,
    rocking: V::Mask,
    tried: V::Mask,
    lifted: V::Mask,
    y: &Motion<V>,
    extremes: &Extremes<V>,
) -> V::Mask {
    let (variant, model) = (set.variant, set.model);
    let (zero, half, two) = (y.u.like(0.0), y.u.like(0.5), y.u.like(2.0));
    let more = y.u.like(1.0 + MARGIN);
    let (base_h, base_v) = (base_energy_h(set, y), base_energy_v(set, y));
    // What is left of them at most. A block in full contact may yet lift, and the base's energies
    // are then the least that each can be.
    let mut left_h = more * base_h;
    let mut left_v = more * base_v;
    let mut last = tried & (rocking | within(set, extremes, tried, left_h, left_v));
    if !V::any(last) {
        return last;
    }
    // In full contact u and v are not coupled: |X| and |Y - g| by Cauchy's inequality.
    let mut x_most = zero;
    let mut y_swing = zero;
    let mut stays = !rocking;
    if V::any(last & !rocking) {
        x_most = most_x(set, left_h.sqrt());
        y_swing = most_y(set, left_v.sqrt());
        let pressed = model.least_arm * (model.gravity - y_swing);
        stays = stays & pressed.gt(model.height * x_most);
    }
    let mut energy = zero;
    if V::any(last & !stays) {
        // Otherwise the whole energy over M, in whichever coordinate.
        energy = half * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
        if V::any(last & rocking) {
            // At an impact phi = 0: P = H and Q = s b.
            let arm = corner.side * corner.arm;
            let push = arm * y.dv - model.height * y.du + half * corner.inertia * y.dphi;
            energy = V::select(rocking, push.mul_add(y.dphi, energy), energy);
        }
        energy = model.impact_gain * more * energy;
        left_h = V::select(stays, left_h, two * model.mu_h * energy);
        left_v = V::select(stays, left_v, two * model.mu_v * energy);
        let small = lifted & model.topple_energy.gt(energy);
        last = last & (stays | small) & within(set, extremes, tried, left_h, left_v);
        if !V::any(last) {
            return last;
        }
        if variant.asked.angles {
            let bound_left = model.gravity * least_rise(set, &model.left, extremes.max_phi_left);
            let bound_right = model.gravity * least_rise(set, &model.right, extremes.max_phi_right);
            last = last & (stays | (bound_left.ge(energy) & bound_right.ge(energy)));
        }
        x_most = most_x(set, left_h.sqrt());
        y_swing = most_y(set, left_v.sqrt());
    }
    if variant.asked.accelerations {
        // In full contact plate and block move alike.
        let least = more * extremes.acc_plate.min(extremes.acc_block);
        let least_total = more * extremes.acc_plate_total.min(extremes.acc_block_total);
        let y_most = model.gravity + y_swing;
        let held = least.ge(x_most)
            & (least_total * least_total).ge(x_most.mul_add(x_most, y_most * y_most));
        let load = base_load(set, y_most, y_most, model.gravity);
        last = last & stays & held & (more * extremes.base_load).ge(load);
    }
    if !variant.asked.forces {
        return last;
    }
    forces_are_final(set, extremes, last, stays, x_most, y_swing, energy)
}

/// The lanes of `tried` whose contact forces pass no extreme: those of blocks that stay in full contact, and those of
/// others, with an energy over M left to their rotation.
#[inline(always)]
pub(super) fn forces_are_final<V: Vector>(
    set: &CellEquations<V>,
    extremes: &Extremes<V>,
    tried: V::Mask,
    stays: V::Mask,
    x_most: V,
    y_swing: V,
    energy: V,
) -> V::Mask {
    let model = set.model;
    let (zero, one) = (energy.like(0.0), energy.like(1.0));
    let (margin, more) = (energy.like(MARGIN), energy.like(1.0 + MARGIN));
    // The least normal force and the largest share of the shear.
    let share = V::select(stays, one, model.normal_share);
    let turn = V::select(stays, zero, energy);
    let by_shear = V::select(stays, zero, model.normal_by_shear * x_most);
    let by_normal = V::select(stays, zero, model.shear_by_normal * (model.gravity + y_swing));
    let normal = share * (model.gravity - y_swing) - by_shear - model.normal_by_turn * turn;
    let shear = x_most + by_normal + model.shear_by_turn * turn;
    let pressed = normal.ge(extremes.min_contact - margin * extremes.min_contact.abs());
    let held = (more * extremes.friction * normal).ge(shear);
    tried & pressed & held
}
