//! A scene made ready: its resolution, what is left out, and the parts that run one model each.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Zeroable;
use serde::Serialize;

use super::backend::Precision;
use super::clock::Resolution;
use super::shared::Kept;
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::{Excitation, Grid, Point, Scene, SceneError, positive};

/// A vertical isolation whose period is below this share of a record's time step is rigid for that
/// record, which holds nothing faster than two steps.
pub const RIGID_SHARE: f64 = 0.2;

/// Most steps that a cell may take: some minutes of one core.
pub const MOST_STEPS: f64 = 1.0e9;

/// What a sweep leaves out where it has no say in the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Reductions {
    /// No hysteretic variable where the base is linear (psi = 1).
    pub linear: bool,
    /// No time after energy has proved all results final.
    pub certificate: bool,
    /// No motion in full contact by each cell: it is integrated once for all cells that share it.
    pub full_contact: bool,
}

impl Reductions {
    /// Everything that has no say is left out.
    pub const ALL: Reductions = Reductions { linear: true, certificate: true, full_contact: true };
    /// Nothing is: the full model.
    pub const NONE: Reductions =
        Reductions { linear: false, certificate: false, full_contact: false };
}

/// Cells that run one model.
#[derive(Debug, Clone)]
pub struct Part {
    /// The plan of these cells.
    pub plan: Plan,
    /// The cells' numbers in the grid.
    pub cells: Vec<usize>,
    /// Their vertical isolation is rigid for the record, and is locked.
    pub vertical_locked: bool,
}

/// A scene made ready for its cells.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The scene; of a part, what the part simulates.
    pub scene: Scene,
    /// How finely its cells are stepped.
    pub resolution: Resolution,
    /// What of the model is left out where it has no say.
    pub reductions: Reductions,
    /// M/(M + m_h + m_v); zero where the horizontal direction is locked.
    pub(super) mu_h: f64,
    /// M/(M + m_v); zero where the vertical direction is locked.
    pub(super) mu_v: f64,
    /// What its tiles share.
    pub(super) kept: Arc<Kept>,
}

impl Plan {
    /// The plan of a scene with steps of at most `largest_step` seconds.
    ///
    /// # Errors
    /// A step that is no positive number, and a duration of more than [`MOST_STEPS`] steps.
    pub fn new(scene: &Scene, largest_step: f64) -> Result<Plan, SceneError> {
        Plan::resolved(scene, Resolution::bounded(largest_step))
    }

    /// The plan of a scene with steps of a given resolution.
    ///
    /// # Errors
    /// Those of [`Plan::new`].
    pub fn resolved(scene: &Scene, resolution: Resolution) -> Result<Plan, SceneError> {
        positive("step", resolution.largest_step)?;
        let (block, base) = (&scene.block, &scene.isolation);
        let mass_v = block.mass + base.plate_v;
        let mass_h = mass_v + base.plate_h;
        let mu_h = if base.horizontal.is_some() { block.mass / mass_h } else { 0.0 };
        let mu_v = if base.vertical.is_some() { block.mass / mass_v } else { 0.0 };
        let (copy, reductions, kept) = (scene.clone(), Reductions::ALL, Arc::default());
        let plan = Plan { scene: copy, resolution, reductions, mu_h, mu_v, kept };
        let mut shortest = Grid::of(scene).extreme();
        if let Some(rigid) = plan.rigid_period() {
            // Stiffer cells run without the vertical direction.
            shortest.t_v = shortest.t_v.max(rigid);
        }
        let clock = plan.clock(&shortest);
        let steps = plan.scene.t_max / clock.step_forced.max(f64::MIN_POSITIVE);
        if steps > MOST_STEPS {
            let problem = format!(
                "{} s take more than {MOST_STEPS:e} steps at the shortest period; shorten t_max, or \
                 lock a direction as stiff as that",
                scene.t_max
            );
            return Err(SceneError::new("t_max", problem));
        }
        Ok(plan)
    }

    /// The plan for a number type: short periods take more steps in f64.
    pub fn at(&self, precision: Precision) -> Plan {
        Plan { resolution: self.resolution.at(precision), ..self.clone() }
    }

    /// The plan with nothing left out.
    pub fn full_model(&self) -> Plan {
        Plan { reductions: Reductions::NONE, ..self.clone() }
    }

    /// The plan with steps half as long.
    pub fn halved(&self) -> Plan {
        Plan { resolution: self.resolution.halved(), ..self.clone() }
    }

    /// T_v below which the vertical isolation is rigid for the scene's record, s.
    pub fn rigid_period(&self) -> Option<f64> {
        match &self.scene.excitation {
            Excitation::Record(pair) if self.scene.isolation.vertical.is_some() => {
                Some(RIGID_SHARE * pair.dt)
            }
            _ => None,
        }
    }

    /// True for a cell whose vertical isolation is rigid for the record, and is locked.
    pub fn locks_vertical(&self, point: &Point) -> bool {
        self.rigid_period().is_some_and(|rigid| point.t_v < rigid)
    }

    /// The plan of some of a grid's cells in parts that each run one model: cells as they are, and those whose vertical
    /// isolation is rigid for the record, with that direction locked.
    pub fn parts(&self, grid: &Grid, cells: Range<usize>) -> Vec<Part> {
        let (stiff, cells): (Vec<usize>, Vec<usize>) =
            cells.partition(|&index| self.locks_vertical(&grid.point(index)));
        let mut parts = Vec::new();
        if !cells.is_empty() {
            parts.push(Part { plan: self.clone(), cells, vertical_locked: false });
        }
        if !stiff.is_empty() {
            parts.push(Part { plan: self.without_vertical(), cells: stiff, vertical_locked: true });
        }
        parts
    }

    /// The same with the horizontal direction locked.
    pub(super) fn without_horizontal(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation.horizontal = None;
        plan.mu_h = 0.0;
        plan
    }

    /// The same with the vertical direction locked.
    pub(super) fn without_vertical(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation.vertical = None;
        plan.mu_v = 0.0;
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

    /// True where z is integrated. Where psi = 1 it has no part in any force; the full model carries it
    /// all the same, and must resolve it.
    pub(super) fn has_hysteretic_variable(&self) -> bool {
        let linear = self.reductions.linear;
        self.scene.isolation.horizontal.is_some_and(|law| law.psi < 1.0 || !linear)
    }

    /// What the scene switches on.
    pub fn variant(&self) -> Variant {
        let base = &self.scene.isolation;
        let yields = self.has_hysteretic_variable();
        Variant {
            recorded: matches!(self.scene.excitation, Excitation::Record(_)),
            isolated_h: base.horizontal.is_some(),
            isolated_v: base.vertical.is_some(),
            kinks: self.resolution.kinks && yields,
            yields,
            certificate: self.reductions.certificate,
            bouc_wen_n: base.horizontal.map_or(2, |h| h.n),
        }
    }
}
