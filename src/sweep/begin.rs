//! A cell as its integration begins: its numbers and its first state. Twin of `shaders/begin.wgsl`.

use bytemuck::Zeroable;

use super::cell_tables::{CellTables, Place};
use super::full_contact::Tracks;
use super::groups::Groups;
use super::plan::Plan;
use super::shared_contact::full_contact;
use crate::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::excitation::Cell;
use crate::model::real::Real;
use crate::scene::{GRAVITY, Point};
use crate::stepping::state::{DIVERGED, RUNNING, State};

/// How a block begins.
#[derive(Debug, Clone, Copy)]
pub struct Posture<R> {
    /// phi, rad.
    pub tilt: R,
    /// The corner that a tilted block turns about.
    pub mode: u32,
}

impl Plan {
    /// How the scene's block begins.
    pub fn posture<R: Real>(&self) -> Posture<R> {
        let tilt = self.scene.tilt;
        let mode = match tilt {
            tilt if tilt > 0.0 => ROCKING_LEFT,
            tilt if tilt < 0.0 => ROCKING_RIGHT,
            _ => FULL_CONTACT,
        };
        Posture { tilt: R::of(tilt), mode }
    }

    /// A cell's numbers and the state that it starts in: at rest, the base in static equilibrium.
    pub fn cell<R: Real>(&self, point: &Point) -> (Cell<R>, State<R>) {
        let groups = Groups {
            horizontal: self.horizontal(point.t_h, point.a_h),
            vertical: self.vertical(point.t_v),
            drive: self.drive(point.a_h, point.a_v, None),
            steps: self.steps(point.omega, &self.clock(point), self.fall()),
        };
        let cell = groups.cell();
        let state = at_rest(&cell, groups.sound(), &self.posture());
        (cell, state)
    }
}

/// A cell of a grid and its first state.
#[inline(always)]
pub fn begin<R: Real>(
    tables: &CellTables<R>,
    tracks: Option<&Tracks<R>>,
    posture: &Posture<R>,
    place: Place,
) -> (Cell<R>, State<R>) {
    let groups = tables.groups(place);
    let cell = groups.cell();
    let mut state = at_rest(&cell, groups.sound(), posture);
    if let Some(tracks) = tracks
        && state.status == RUNNING
    {
        full_contact(tracks, place, groups.drive.scale, &cell, &mut state);
    }
    (cell, state)
}

/// A state at rest, the base in static equilibrium.
#[inline(always)]
fn at_rest<R: Real>(cell: &Cell<R>, sound: bool, posture: &Posture<R>) -> State<R> {
    let mut state = State::<R>::zeroed();
    if cell.deflection > R::of(0.0) {
        state.motion.v = -cell.deflection;
    }
    state.motion.phi = posture.tilt;
    state.max_v = cell.deflection;
    state.min_contact = R::of(GRAVITY);
    state.mode = posture.mode;
    if !sound {
        state.status = DIVERGED;
    }
    state
}
