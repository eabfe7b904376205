//! What the motions in full contact depend on: see [`full_contact`](super::full_contact).

use crate::cells::clock_parts::clock_parameters;
use crate::cells::plan::Plan;
use crate::cells::window::{Combinations, Window};
use crate::scene::{Directions, Grid, Parameter};

/// The masses by which the yield force of a base in newtons is divided.
const MASSES: [Parameter; 3] = [Parameter::Mass, Parameter::PlateH, Parameter::PlateV];
/// The parameters of the motion of the ground, beside the amplitudes of a pulse.
const GROUND: [Parameter; 6] = [
    Parameter::Scale,
    Parameter::Pga,
    Parameter::Omega,
    Parameter::Cycles,
    Parameter::Gamma,
    Parameter::Phase,
];

/// The parameters that the motions of each direction depend on, and whether v is at rest.
pub(crate) struct Dependence {
    pub(crate) across: Vec<Parameter>,
    pub(crate) up: Vec<Parameter>,
    pub(crate) still: bool,
}

impl Dependence {
    pub(crate) fn of(plan: &Plan, grid: &Grid) -> Dependence {
        let base = plan.scene.isolation;
        let recorded = plan.scene.excitation.record().is_some();
        let still = !recorded
            && grid
                .corners()
                .all(|case| case.shaking.pulse().is_some_and(|pulse| pulse.a_v == 0.0));
        let (mut across, mut up) = (GROUND.to_vec(), Vec::new());
        if base.moves_h() {
            across.extend(Parameter::of_direction(Directions::Horizontal));
            if grid.gives_strength() {
                across.extend(MASSES);
            }
        }
        if !still {
            up.extend(GROUND);
            up.push(Parameter::AV);
        }
        if base.moves_v() {
            let own = Parameter::of_direction(Directions::Vertical);
            // A base at rest is displaced by its static deflection.
            up.extend(own.filter(|parameter| !still || *parameter == Parameter::TV));
        }
        if !recorded {
            // The steps of a pulse are those of the cells.
            across.extend(clock_parameters(grid));
            if shared_amplitude(plan, grid).is_none() {
                across.push(Parameter::AH);
            }
            if !still {
                up.extend(clock_parameters(grid));
            }
        }
        Dependence { across, up, still }
    }

    /// All combinations of the values that the motions of u and of v depend on.
    pub(crate) fn combinations(&self, grid: &Grid) -> [Combinations; 2] {
        let window = Window::whole(grid);
        [&self.across, &self.up].map(|parameters| window.combinations(grid, parameters))
    }
}

/// A_h of the shared motions of u, m/s^2: by (21) u is proportional to A_h. None under a record, and where the
/// strength of the base is given: there u is not proportional to A_h.
pub(crate) fn shared_amplitude(plan: &Plan, grid: &Grid) -> Option<f64> {
    if plan.scene.excitation.record().is_some() || grid.gives_strength() {
        return None;
    }
    let amplitudes = grid.corners().map(|case| case.shaking.peak_h());
    Some(amplitudes.fold(0.0, f64::max))
}
