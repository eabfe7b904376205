//! The state of a cell at rest, and one cell made by itself. Twin of `shaders/at_rest.wgsl`.

use bytemuck::Zeroable;

use super::body::Body;
use super::groups::{Drive, Groups, Horizontal, Steps, Vertical};
use super::plan::Plan;
use crate::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::scene::{Case, GRAVITY};
use crate::stepping::state::{DIVERGED, State};

/// The corner that a block of this tilt turns about.
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

/// A state at rest, the base in static equilibrium.
#[inline(always)]
pub(crate) fn at_rest<R: Real>(finite: bool, tilt: R) -> State<R> {
    let mut state = State::<R>::zeroed();
    state.motion.phi = tilt;
    state.min_contact = R::of(GRAVITY);
    state.mode = mode_of(tilt);
    if !finite {
        state.status = DIVERGED;
    }
    state
}

impl Plan {
    /// A cell's numbers and the state that it starts in: at rest, the base in static equilibrium. Its body
    /// is number 0.
    pub fn cell<R: Real>(&self, case: &Case) -> (Cell<R>, State<R>) {
        let case = self.locked(case);
        let body = Body::of(&case);
        let groups = Groups {
            horizontal: Horizontal::of(&case, &body),
            vertical: Vertical::of(&case, &body),
            drive: Drive::of(&case, None),
            steps: Steps::of(self.span(&case).omega, &self.clock(&case), body.fall()),
            body: 0,
        };
        let cell = groups.cell();
        let state = at_rest(groups.finite(), groups.drive.tilt);
        (cell, state)
    }
}
