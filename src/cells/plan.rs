//! A scene made ready to run: its step lengths, its shortcuts, and its parts that run one model each.

use std::sync::Arc;

use bytemuck::Zeroable;

use super::body::{Body, body_parameters};
use super::clock::Resolution;
use super::contact::motion_cache::MotionCache;
use super::laws::Laws;
use super::shortcuts::Shortcuts;
use crate::model::block::Model;
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::precision::Precision;
use crate::model::pulse::Shape;
use crate::model::real::Real;
use crate::scene::{Case, Excitation, Grid, Parameter, Scene};

/// A vertical isolation whose period is below this share of a record's time step is rigid for that
/// record, which holds nothing faster than two steps.
pub const RIGID_SHARE: f64 = 0.2;

/// Cells that run one model.
#[derive(Debug, Clone)]
pub struct Part {
    /// The plan of these cells.
    pub plan: Plan,
    /// The cells' numbers in the grid.
    pub cells: Vec<usize>,
    /// Their places in the list that was divided into parts.
    pub places: Vec<usize>,
    /// Their vertical isolation is rigid for the record, and is locked.
    pub vertical_locked: bool,
}

/// A scene made ready for its cells.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The scene; of a part, the scene with the directions locked that the part locks.
    pub scene: Scene,
    /// How finely its cells are stepped.
    pub resolution: Resolution,
    /// Shortcuts that cannot change the result.
    pub shortcuts: Shortcuts,
    /// Contact forces are asked for: where they are not, min_contact and the friction asked for are not looked for.
    pub forces: bool,
    /// The laws that all its cells have.
    pub(crate) laws: Laws,
    /// Its cells differ in their body.
    bodies: bool,
    /// A pulse of some cell has more than one cycle.
    cycles: bool,
    /// The cache of full-contact motions, shared by all tiles.
    pub(crate) motion_cache: Arc<MotionCache>,
}

impl Plan {
    /// The plan of a scene, not yet [checked](Plan::resolved) for the number of its steps.
    pub(crate) fn unchecked(scene: &Scene, resolution: Resolution) -> Plan {
        let laws = Laws { moves: [false; 2], yields: false, bouc_wen_n: 2 };
        let (copy, shortcuts, motion_cache) = (scene.clone(), Shortcuts::ALL, Arc::default());
        let bodies = Grid::of(scene).sweeps(&body_parameters());
        let most = scene.numbers.get(Parameter::Cycles).map_or(1.0, |values| values.ends().1);
        let cycles = most > 1.0;
        let mut plan = Plan {
            scene: copy,
            resolution,
            shortcuts,
            forces: true,
            laws,
            bodies,
            cycles,
            motion_cache,
        };
        plan.laws = plan.laws_of(&scene.case());
        plan
    }

    /// The plan for a number type: short periods take more steps in f64.
    pub fn at(&self, precision: Precision) -> Plan {
        Plan { resolution: self.resolution.at(precision), ..self.clone() }
    }

    /// The plan without shortcuts.
    pub fn full_model(&self) -> Plan {
        let mut plan = Plan { shortcuts: Shortcuts::NONE, ..self.clone() };
        plan.laws = plan.laws_of(&plan.scene.case());
        plan
    }

    /// The plan of a sweep of which nobody asks for contact forces.
    pub fn without_forces(&self) -> Plan {
        Plan { forces: false, ..self.clone() }
    }

    /// The plan with steps half as long.
    pub fn halved(&self) -> Plan {
        Plan { resolution: self.resolution.halved(), ..self.clone() }
    }

    /// T_v below which the vertical isolation is rigid for the scene's record, s.
    pub fn rigid_period(&self) -> Option<f64> {
        match &self.scene.excitation {
            Excitation::Record(pair) if self.scene.isolation.moves_v() => {
                Some(RIGID_SHARE * pair.dt)
            }
            _ => None,
        }
    }

    /// True for a cell whose vertical isolation is rigid for the record, and is locked.
    pub fn locks_vertical(&self, case: &Case) -> bool {
        let t_v = case.isolation.vertical.map(|law| law.t_v);
        t_v.is_some_and(|t_v| self.rigid_period().is_some_and(|rigid| t_v < rigid))
    }

    /// A cell with the directions locked that are locked in this plan.
    pub(crate) fn locked(&self, case: &Case) -> Case {
        let mut case = *case;
        if !self.scene.isolation.moves_h() {
            case.isolation.horizontal = None;
        }
        if !self.scene.isolation.moves_v() {
            case.isolation.vertical = None;
        }
        case
    }

    /// The model that a cell runs.
    fn laws_of(&self, case: &Case) -> Laws {
        let base = self.locked(case).isolation;
        Laws {
            moves: [base.horizontal.is_some(), base.vertical.is_some()],
            yields: base.horizontal.is_some_and(|law| self.has_hysteretic_variable(law.psi)),
            bouc_wen_n: base.horizontal.map_or(2, |law| law.n),
        }
    }

    /// The plan of some of a grid's cells in parts that each run one model: cells whose base yields and
    /// those whose base does not, those of one exponent n, and those whose vertical isolation is rigid for
    /// the record, with that direction locked. The cells may be in any order.
    pub fn parts(&self, grid: &Grid, cells: &[usize]) -> Vec<Part> {
        let deciding = [Parameter::Psi, Parameter::BoucWenN, Parameter::TV];
        let Some(first) = cells.first() else { return Vec::new() };
        if !grid.sweeps(&deciding) && !self.locks_vertical(&grid.case(*first)) {
            return vec![Part {
                plan: self.clone(),
                cells: cells.to_vec(),
                places: (0..cells.len()).collect(),
                vertical_locked: false,
            }];
        }
        let mut parts: Vec<Part> = Vec::new();
        for (place, &cell) in cells.iter().enumerate() {
            let case = grid.case(cell);
            let vertical_locked = self.locks_vertical(&case);
            let mut laws = self.laws_of(&case);
            laws.moves[1] &= !vertical_locked;
            if let Some(part) = parts.iter_mut().find(|part| part.plan.laws == laws) {
                part.cells.push(cell);
                part.places.push(place);
                continue;
            }
            let mut plan = if vertical_locked { self.without_vertical() } else { self.clone() };
            plan.laws = laws;
            parts.push(Part { plan, cells: vec![cell], places: vec![place], vertical_locked });
        }
        // Parts without a locked direction come first.
        parts.sort_by_key(|part| part.vertical_locked);
        parts
    }

    /// The same with the horizontal direction locked.
    pub(crate) fn without_horizontal(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation = plan.scene.isolation.without_horizontal();
        plan.laws.moves[0] = false;
        plan.laws.yields = false;
        plan
    }

    /// The same with the vertical direction locked.
    pub(crate) fn without_vertical(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation = plan.scene.isolation.without_vertical();
        plan.laws.moves[1] = false;
        plan
    }

    /// The samples of the record, and two zeros where there is none.
    pub fn record<R: Real>(&self) -> Vec<Ground<R>> {
        match &self.scene.excitation {
            Excitation::Record(pair) => pair
                .horizontal
                .iter()
                .zip(pair.vertical.iter())
                .map(|(h, v)| Ground { h: R::of(*h), v: R::of(*v) })
                .collect(),
            Excitation::Pulse(_) => vec![Ground::zeroed(); 2],
        }
    }

    /// True where z is integrated. Where psi = 1 no force depends on it; the full model integrates it all
    /// the same, and needs steps that resolve it.
    pub(crate) fn has_hysteretic_variable(&self, psi: f64) -> bool {
        psi < 1.0 || !self.shortcuts.linear
    }

    /// The numbers of a cell's equations that come from its block and the masses of its base.
    pub fn model<R: Real>(&self, case: &Case) -> Model<R> {
        Body::of(&self.locked(case)).model()
    }

    /// The variant of the model that the scene needs; of a part, the one that all its cells need.
    pub fn variant(&self) -> Variant {
        let Laws { moves: [isolated_h, isolated_v], yields, bouc_wen_n } = self.laws;
        let (recorded, pulse) = match self.scene.excitation {
            Excitation::Record(_) => (true, Shape::OneSine),
            Excitation::Pulse(shape) => (false, shape),
        };
        Variant {
            recorded,
            pulse,
            cycles: self.cycles,
            isolated_h,
            isolated_v,
            kinks: self.resolution.kinks && yields,
            yields,
            certificate: self.shortcuts.certificate,
            forces: self.forces,
            bodies: self.bodies,
            bouc_wen_n,
        }
    }
}
