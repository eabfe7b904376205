//! The proof that nothing more will happen. Twin of `shaders/certificate.wgsl`.
//!
//! Once the excitation is over the system is passive: (9) and (11) only take energy out, and so does
//! an impact (15). What is left of it bounds every coordinate from then on; where no bound reaches
//! beyond what the cell has seen already, its outcome and its largest values are final, and it ends.

use super::state::{PROVED, State};
use crate::model::Setting;
use crate::model::block::{Corner, FULL_CONTACT, pivot};
use crate::model::dynamics::{Lever, lever_at};
use crate::model::real::Real;

/// Steps from one try to the next, less one; a power of two less one.
pub const TRIES: u32 = 15;
/// Share by which a bound must hold: far more than the rounding of an energy, also where the
/// energy is a small difference from that of rest.
const MARGIN: f64 = 1.0e-3;

/// True where it is time to try: the excitation is over.
#[inline(always)]
pub fn is_due<R: Real>(set: &Setting<R>, state: &State<R>) -> bool {
    set.variant.certificate && state.step >= set.cell.steps_forced && (state.step & TRIES) == 0
}

/// P - H: height that the centre of mass has gained at phi about a corner, m.
#[inline(always)]
fn rise<R: Real>(set: &Setting<R>, corner: &Corner<R>, phi: R) -> R {
    // H (1 - cos phi) by the half angle, for 1 - cos phi of a small phi is all rounding.
    let half_sine = (R::of(0.5) * phi).sine();
    corner.side * corner.arm * phi.sine() - R::of(2.0) * set.model.height * half_sine * half_sine
}

/// Ends the cell if all that it tells is final.
pub fn certify<R: Real>(set: &Setting<R>, state: &mut State<R>) {
    let (variant, model, cell) = (set.variant, set.model, set.cell);
    let (zero, half, two) = (R::of(0.0), R::of(0.5), R::of(2.0));
    let more = R::of(1.0 + MARGIN);
    let y = state.motion;
    // Twice the energies of the base over M_t and M_v, from rest; the vertical one holds gravity.
    let mut base_h = zero;
    if variant.isolated_h {
        base_h = y.du * y.du + cell.post_yield * y.u * y.u + cell.yield_energy * y.z * y.z;
    }
    let mut base_v = zero;
    if variant.isolated_v {
        let lift = y.v + cell.deflection;
        base_v = y.dv * y.dv + cell.stiffness_v * lift * lift;
    }
    let mut left_h = more * base_h;
    let mut left_v = more * base_v;
    let mut stays = false;
    if state.mode == FULL_CONTACT {
        // |X| and |Y - g| by Cauchy's inequality; u and v do not see each other.
        let x_most = cell.reach_h * left_h.sqrt();
        let y_least = model.gravity - cell.reach_v * left_v.sqrt();
        stays = model.height * x_most < model.least_arm * y_least;
    }
    if !stays {
        let mut energy = half * (model.inverse_mu_h * base_h + model.inverse_mu_v * base_v);
        if state.mode != FULL_CONTACT {
            let corner = pivot(model, state.mode);
            let Lever { p, q } = lever_at(set, &corner, y.phi);
            let push = q * y.dv - p * y.du + half * corner.inertia * y.dphi;
            energy = energy + push * y.dphi + model.gravity * rise(set, &corner, y.phi);
        }
        energy = more * energy;
        let bound_left = model.gravity * rise(set, &model.left, state.max_phi_left);
        let bound_right = model.gravity * rise(set, &model.right, -state.max_phi_right);
        if !(energy < model.topple_energy && energy <= bound_left && energy <= bound_right) {
            return;
        }
        left_h = two * model.mu_h * energy;
        left_v = two * model.mu_v * energy;
    }
    // The largest |u| and |v| that this can still make.
    let far_h = left_h > cell.post_yield * state.max_u * state.max_u;
    // A base at rest trembles by the rounding of its deflection.
    let up = state.max_v - cell.deflection + R::EVENT_TOLERANCE * cell.deflection;
    let far_v = up < zero || left_v > cell.stiffness_v * up * up;
    if (variant.isolated_h && far_h) || (variant.isolated_v && far_v) {
        return;
    }
    state.status = PROVED;
}
