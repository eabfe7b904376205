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
//! of this energy E reaches an angle of at most 1.1 E/least, and lasts at most 2.2 D w/least (2 by the moment at
//! phi = 0, and 1.1 = artanh(1/2)/(1/2) because the moment decreases); the factors are taken as 1.25 and 2.5, because
//! D changes with phi. If the base moves by no more than a radian in that time, the flights are those of a ball that
//! bounces under a force that changes slowly: its adiabatic invariant, E^(3/2)/force, decreases at impacts alone.
//! Hence no flight lasts longer than the first one would at the least moment. From the moment now on, none has more
//! than (most/now)^(2/3) times the energy of the first, or reaches more than (now/least)^(1/3) times its angle. A
//! radian is not slow: the powers are taken as 1 and 1/2, and the angle 1.6 times as large, which holds for bouncing
//! motions under moments of two frequencies (`a_ball_that_bounces` in tests/engine/shortcuts.rs). The energy bounds
//! the contact forces.
//!
//! By (15b), v + mu_v (P - H) moves as v would move without the flights, under a spring that is shifted by
//! mu_v (P - H). As the flights are short, v follows their mean height, which decreases from impact to impact; their
//! changes, where they are in resonance with v, add little as long as the impacts take energy. So v differs by at
//! most `moved` from its motion without flights (`an_oscillator_moves` in the same file), its velocity by `kick`, and the
//! vertical force by what these make of the spring and the damper. u is bounded by the energy, as above.

use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::excitation::Ground;
use crate::model::impact::come_to_rest;
use crate::model::isolation::support;
use crate::model::motion::Motion;
use crate::model::real::Vector;

use super::certificate::{
    MARGIN, base_energy_h, base_energy_v, forces_are_final, most_x, most_y, within,
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
    let (zero, half, one, two) = (y.u.like(0.0), y.u.like(0.5), y.u.like(1.0), y.u.like(2.0));
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
    // The moment that holds the block, by the inequality of Cauchy as in the certificate.
    let x_most = most_x(set, root_h);
    let y_swing = most_y(set, root_v);
    let least_y = model.gravity - y_swing;
    let least = model.least_arm * least_y - model.height * x_most;
    let most = arm * (model.gravity + y_swing) + model.height * x_most;
    let fall = model.height * least_y + arm * x_most;
    // The same at this moment, about the corner with the smaller one.
    let still = Ground { h: zero, v: zero };
    let base_now = support(set, &rested, still);
    let now = model.least_arm * base_now.f_v - model.height * base_now.f_h.abs();
    let energy = flight * most / now;
    let held = y.u.like(4.0) * energy * (least + two * fall);
    let radians = y.u.like(2.5) * momentum * cell.horizontal.reach_h.max(cell.vertical.reach_v);
    let eta = model.left.eta_phi.max(model.right.eta_phi);
    let loss = (one - eta * eta * eta).max(y.u.like(1.0e-6));
    rests = rests & least.gt(zero) & least.ge(radians) & (least * least).ge(held);
    if !V::any(rests) {
        return rests;
    }
    let angle = two * flight / (now * least).sqrt();
    if set.variant.asked.angles {
        rests = rests & extremes.max_phi_left.min(extremes.max_phi_right).ge(angle);
    }
    // How far the flights move the base, and how fast.
    let share = y.u.like(1.25) + y.u.like(0.02) * radians / (least * loss);
    let moved = model.mu_v * arm * angle * share;
    let kick = model.mu_v * arm * speed * (most / now).sqrt();
    let root_v_moved = base_v.sqrt() + cell.vertical.reach_v * moved;
    rests = within(set, extremes, rests, root_h * root_h, root_v_moved * root_v_moved);
    if !set.variant.asked.forces {
        return rests;
    }
    let swing = cell.vertical.reach_v * (root_v_moved + cell.vertical.reach_v * moved)
        + cell.vertical.damping_v * kick;
    forces_are_final(set, extremes, rests, zero.mask(0), x_most, y_swing.min(swing), energy)
}
