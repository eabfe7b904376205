//! The state of a cell at rest. Twin of `shaders/at_rest.wgsl`.

use bytemuck::Zeroable;

use crate::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::real::Real;
use crate::scene::GRAVITY;
use crate::stepping::state::{DIVERGED, State};

/// The corner about which a block of this tilt turns.
#[inline(always)]
fn mode_of<R: Real>(tilt: R) -> u32 {
    let zero = R::of(0.0);
    if tilt > zero {
        ROCKING_LEFT
    } else if tilt < zero {
        ROCKING_RIGHT
    } else {
        FULL_CONTACT
    }
}

/// A state at rest, with the base in static equilibrium.
#[inline(always)]
pub(crate) fn at_rest<R: Real>(finite: bool, tilt: R) -> State<R> {
    let mut state = State::<R>::zeroed();
    state.motion.phi = tilt;
    state.extremes.min_contact = R::of(GRAVITY);
    state.mode = mode_of(tilt);
    if !finite {
        state.status = DIVERGED;
    }
    state
}
