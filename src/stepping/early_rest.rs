//! Rest before the last flights end: the proof that the block is about to come to rest for good, and that its flights
//! until then change nothing that is told of the cell. Twin of `shaders/early_rest.wgsl`.
//!
//! A block that chatters makes most of its impacts in flights that are shorter than a step. Let it come to rest at an
//! impact, by (15a) and (15b): with w = |phi'| after the impact the rest takes away the energy D w^2/2 over M, D as in
//! the [`certificate`](super::certificate) at phi = 0, and the flights that are left out share it. From the energies of the base
//! after that rest follow bounds of |X| and |Y - g|, and of the moment over M that holds the block,
//!
//! ```text
//! hold = b (g - |Y - g|) - H |X|
//! ```
//!
//! Where it stays positive the block never lifts again once it rests. A flight lasts no longer than 2 D w/hold. In
//! that time the moment changes by its rate times the time, and the energy of the flight by no larger a share; an
//! impact takes more than that, so that flights shrink like a geometric series. The first one's angle is the largest,
//! the energy by which it may be reached bounds it, and zeta is final where larger angles have been reached. Meanwhile the
//! centre of mass moves on the base by no more than H phi and b phi, and with it u and v by mu_h and mu_v of that:
//! their error, and that of both contact forces, is bounded by a share of the largest so far.

use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::impact::come_to_rest;
use crate::model::motion::Motion;
use crate::model::real::Vector;

use super::certificate::{MARGIN, base_energy_h, base_energy_v, least_rise};
use super::extremes::Extremes;

/// Share of its largest value so far by which what is left out may change u, v, the least contact force or
/// the friction asked for.
pub const LEFT_OUT: f64 = 1.0e-2;

/// The lanes of `tried`, which have just had an impact under no excitation, whose block may rest at once.
#[inline(always)]
pub fn rests_early<V: Vector>(
    set: &CellEquations<V>,
    corner: &Corner<V>,
    tried: V::Mask,
    y: &Motion<V>,
    extremes: &Extremes<V>,
) -> V::Mask {
    let (variant, model, cell) = (set.variant, set.model, set.cell);
    let (zero, half, two) = (y.u.like(0.0), y.u.like(0.5), y.u.like(2.0));
    let more = y.u.like(1.0 + MARGIN);
    let share = y.u.like(LEFT_OUT);
    let speed = y.dphi.abs();
    let arm = model.left.arm.max(model.right.arm);
    let d = corner.inertia
        - model.mu_h * model.height * model.height
        - model.mu_v * corner.arm * corner.arm;
    let momentum = more * d * speed;
    let flights = half * momentum * speed;
    let rested = come_to_rest(set, corner, y);
    let base_h = more * base_energy_h(set, &rested);
    let base_v = more * base_energy_v(set, &rested);
    let base = half * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
    let mut rests = tried & model.topple_energy.gt(model.impact_gain * (base + flights));
    if !V::any(rests) {
        return rests;
    }
    // |X| and |Y - g| by Cauchy's inequality; flights change u' and v' by this much at most.
    let x_most = cell.reach_h * (base_h.sqrt() + two * model.mu_h * model.height * speed);
    let y_swing = cell.reach_v * (base_v.sqrt() + two * model.mu_v * arm * speed);
    let least_y = model.gravity - y_swing;
    let hold = model.least_arm * least_y - model.height * x_most;
    rests = rests & hold.gt(zero);
    // By (10) |X'| <= 5/4 reach_h |X|, and the same of Y.
    let rate_x = y.u.like(1.25) * cell.reach_h * x_most;
    let rate_y = y.u.like(1.25) * cell.reach_v * y_swing;
    let rate = model.height * rate_x + arm * rate_y;
    rests = rests & (model.most_growth * hold * hold).ge(two * momentum * rate);
    // The energy with which the largest angles so far are reached.
    for (corner, most) in
        [(&model.left, extremes.max_phi_left), (&model.right, extremes.max_phi_right)]
    {
        let sideways = most * (model.height + half * corner.arm * most);
        let reached = least_y * least_rise(set, corner, most) - x_most * sideways;
        rests = rests & reached.ge(flights);
    }
    if !V::any(rests) {
        return rests;
    }
    // The largest angle to come, and the time that the flights take together.
    let angle = flights / hold;
    let time = two * model.flights * momentum / hold;
    if variant.isolated_h {
        let change = model.mu_h * model.height * angle * (y.u.like(1.0) + two * cell.reach_h * time);
        rests = rests & (share * extremes.max_u).ge(change);
    }
    if variant.isolated_v {
        let change = model.mu_v * arm * angle * (y.u.like(1.0) + two * cell.reach_v * time);
        let most_v = (cell.deflection - extremes.least_v).max(extremes.most_v - cell.deflection);
        rests = rests & (share * most_v).ge(change);
    }
    if !variant.forces {
        return rests;
    }
    // The contact forces while the block rocks: none beyond the extremes, or, as the base has moved little since the last
    // flight, none far beyond.
    let normal = model.normal_share * least_y
        - model.normal_by_shear * x_most
        - model.normal_by_turn * flights;
    let shear = x_most
        + model.shear_by_normal * (model.gravity + y_swing)
        + model.shear_by_turn * flights;
    let change_n =
        (rate_y + model.normal_by_shear * rate_x) * time + model.normal_by_turn * flights;
    let change_s = (rate_x + model.shear_by_normal * rate_y) * time + model.shear_by_turn * flights;
    let pressed = normal.ge(extremes.min_contact)
        | (share * extremes.min_contact.abs()).ge(change_n);
    let held = (extremes.friction * normal).ge(shear)
        | (share * extremes.friction * normal).ge(change_s + extremes.friction * change_n);
    rests & pressed & held
}
