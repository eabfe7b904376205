//! Rest before the last flights end: the proof that a block at rest will not lift again, and that none of the flights
//! that are left out exceeds a largest or least value so far. Twin of `shaders/early_rest.wgsl`.
//!
//! A block that chatters makes most of its impacts in flights shorter than a step. Assume that it comes to rest at an
//! impact, by (15a) and (15b). With w = |phi'| after the impact this removes the energy D w^2/2 over M, D as in the
//! [`certificate`](super::certificate) at phi = 0, which the flights that are left out would have had. The base keeps
//! the rest of its energy in each direction; the flights would have added at most their own energy to it. So |X| and
//! |Y - g| are bounded, and with them the moment over M that holds the block down,
//!
//! ```text
//! least = b_min (g - |Y - g|) - H |X|        most = b_max (g + |Y - g|) + H |X|
//! ```
//!
//! Where the least moment is positive the block does not lift again after it has come to rest. At an angle phi the
//! moment is at least least cos(phi) - fall sin(phi), with fall = H (g - |Y - g|) + b_max |X|, so that it stops
//! flights with an energy of up to sqrt(least^2 + fall^2) - fall >= least^2/(least + 2 fall). A flight with a quarter
//! of this energy lasts at most 2.2 D w/least (2 by the moment at phi = 0, and 1.1 = artanh(1/2)/(1/2) because the
//! moment decreases); the factor is taken as 2.5, because D changes with phi. If the base moves by no more than a
//! radian in that time, the flights are those of a ball that bounces under a force that changes slowly: its adiabatic
//! invariant, E^(3/2)/force, decreases at impacts alone. Hence no flight lasts longer, or needs more of the moment
//! that holds the block, than this first flight would at the least moment, and none has more than (most/least)^(2/3)
//! times its energy. The larger factor most/least is used, because a radian is not slow. This energy bounds the
//! angles and the contact forces.

use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::impact::come_to_rest;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::Vector;

use super::certificate::{
    MARGIN, base_energy_h, base_energy_v, forces_are_final, least_rise, most_x, most_y, within,
};
use super::extremes::Extremes;

/// The lanes of `tried` whose block may come to rest now. Their excitation is over, and they have just had an impact.
#[inline(always)]
pub fn rests_early<V: Vector>(
    set: &CellEquations<V>,
    corner: &Corner<V>,
    tried: V::Mask,
    y: &Motion<V>,
    extremes: &Extremes<V>,
) -> V::Mask {
    let (model, cell) = (set.model, set.cell);
    if set.variant.asked.accelerations || set.variant.hardens {
        // The accelerations of the later flights, and the rate of a spring that hardens, have no bound here.
        return y.u.like(0.0).mask(0);
    }
    let (zero, half, two) = (y.u.like(0.0), y.u.like(0.5), y.u.like(2.0));
    let more = y.u.like(1.0 + MARGIN);
    // The flights, of which the first one begins now.
    let speed = y.dphi.abs();
    let d = corner.inertia
        - model.mu_h * model.height * model.height
        - model.mu_v * corner.arm * corner.arm;
    let momentum = more * d * speed;
    let flight = model.impact_gain * half * momentum * speed;
    // The base.
    let rested = come_to_rest(set, corner, y);
    let base_h = more * base_energy_h(set, &rested);
    let base_v = more * base_energy_v(set, &rested);
    let base = half * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
    let mut rests = tried & model.topple_energy.gt(base + flight);
    if !V::any(rests) {
        return rests;
    }
    let arm = model.left.arm.max(model.right.arm);
    let root_h = base_h.sqrt() + (two * model.mu_h * flight).sqrt();
    let root_v = base_v.sqrt() + (two * model.mu_v * flight).sqrt();
    rests = within(set, extremes, rests, root_h * root_h, root_v * root_v);
    // The moment that holds the block, by the inequality of Cauchy as in the certificate.
    let x_most = most_x(set, root_h);
    let y_swing = most_y(set, root_v);
    let least_y = model.gravity - y_swing;
    let least = model.least_arm * least_y - model.height * x_most;
    let most = arm * (model.gravity + y_swing) + model.height * x_most;
    let fall = model.height * least_y + arm * x_most;
    let held = y.u.like(4.0) * flight * (least + two * fall);
    let radians = y.u.like(2.5) * momentum * cell.reach_h.max(cell.reach_v);
    rests = rests & least.gt(zero) & least.ge(radians) & (least * least).ge(held);
    if !V::any(rests) {
        return rests;
    }
    let energy = flight * most / least;
    if set.variant.asked.angles {
        // The energy that the largest angles so far require.
        let left = reached(set, &model.left, least_y, x_most, extremes.max_phi_left);
        let right = reached(set, &model.right, least_y, x_most, extremes.max_phi_right);
        rests = rests & left.ge(energy) & right.ge(energy);
    }
    if !set.variant.asked.forces {
        return rests;
    }
    forces_are_final(set, extremes, rests, zero.mask(0), x_most, y_swing, energy)
}

/// The least energy over M of a flight to an angle about a corner.
#[inline(always)]
fn reached<N: Number>(
    set: &CellEquations<N>,
    corner: &Corner<N>,
    least_y: N,
    x_most: N,
    angle: N,
) -> N {
    let sideways = angle * (set.model.height + angle.like(0.5) * corner.arm * angle);
    least_y * least_rise(set, corner, angle) - x_most * sideways
}
