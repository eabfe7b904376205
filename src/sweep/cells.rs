//! From a scene's grid to the numbers that a backend runs on, and back to outcomes.

use std::f64::consts::TAU;

use bytemuck::Zeroable;
use serde::Serialize;

use super::backend::Precision;
use super::clock::{Clock, Resolution};
use crate::integrate::outcome::{Class, Outcome, Status};
use crate::integrate::state::{
    EVENT_LIMIT, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, PROVED, State, check_cell,
};
use crate::model::block::{Corner, Model, ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::{Excitation, GRAVITY, Grid, Overturn, Point, Scene, SceneError, positive};

/// A landing block comes to rest when its next flight would last less than this share of a step.
pub const FLIGHTS_A_STEP: f64 = 32.0;

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
    mu_h: f64,
    mu_v: f64,
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
        let plan =
            Plan { scene: scene.clone(), resolution, reductions: Reductions::ALL, mu_h, mu_v };
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

    /// The plan in parts that each run one model: cells as they are, and those whose vertical
    /// isolation is rigid for the record, with that direction locked.
    pub fn parts(&self, grid: &Grid) -> Vec<Part> {
        let rigid = self.rigid_period().unwrap_or(0.0);
        let (stiff, cells): (Vec<usize>, Vec<usize>) =
            (0..grid.len()).partition(|&index| grid.point(index).t_v < rigid);
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

    /// What the scene switches on.
    pub fn variant(&self) -> Variant {
        let base = &self.scene.isolation;
        let yields = base.horizontal.is_some_and(|law| law.psi < 1.0);
        Variant {
            recorded: matches!(self.scene.excitation, Excitation::Record(_)),
            isolated_h: base.horizontal.is_some(),
            isolated_v: base.vertical.is_some(),
            kinks: self.resolution.kinks && yields,
            yields: base.horizontal.is_some() && (yields || !self.reductions.linear),
            certificate: self.reductions.certificate,
            in_step: self.resolution.in_step,
            bouc_wen_n: base.horizontal.map_or(2, |h| h.n),
        }
    }

    /// rho^2 + H^2 kappa_h + b^2 kappa_v, D of (18) over M M_t M_v, for lever arm `b`.
    fn impact_inertia(&self, b: f64) -> f64 {
        let block = &self.scene.block;
        let rho2 = block.inertia / block.mass;
        let height2 = block.height * block.height;
        rho2 + height2 * (1.0 - self.mu_h) + b * b * (1.0 - self.mu_v)
    }

    /// One corner; `side` is +1 for the left, -1 for the right.
    fn corner<R: Real>(&self, side: f64) -> Corner<R> {
        let block = &self.scene.block;
        let rho2 = block.inertia / block.mass;
        let (h, b, c) = (block.height, block.arm(side), block.arm(-side));
        let width = 2.0 * block.half_width;
        let (kappa_h, kappa_v) = (1.0 - self.mu_h, 1.0 - self.mu_v);
        let d = self.impact_inertia(b);
        let mut eta_phi = (rho2 + h * h * kappa_h - b * c * kappa_v) / d;
        if let Some(restitution) = self.scene.restitution {
            eta_phi = restitution;
        }
        Corner {
            side: R::of(side),
            arm: R::of(b),
            inertia: R::of(rho2 + b * b + h * h),
            overturn: R::of(self.scene.overturning_angle(side)),
            eta_phi: R::of(eta_phi),
            eta_u: R::of(width * b * h * self.mu_h * kappa_v / d),
            eta_v: R::of(width * self.mu_v * (h * h * kappa_h + rho2) / d),
        }
    }

    /// What all cells share.
    pub fn model<R: Real>(&self) -> Model<R> {
        let block = &self.scene.block;
        let radius = |side: f64| f64::hypot(block.arm(side), block.height);
        let inverse = |mu: f64| R::of(if mu > 0.0 { 1.0 / mu } else { 0.0 });
        Model {
            left: self.corner(1.0),
            right: self.corner(-1.0),
            height: R::of(block.height),
            mu_h: R::of(self.mu_h),
            mu_v: R::of(self.mu_v),
            gravity: R::of(GRAVITY),
            inverse_mu_h: inverse(self.mu_h),
            inverse_mu_v: inverse(self.mu_v),
            least_arm: R::of(block.arm(1.0).min(block.arm(-1.0))),
            topple_energy: R::of(GRAVITY * (radius(1.0).min(radius(-1.0)) - block.height)),
        }
    }

    /// The cell's longest step, s: bounded by its fastest period, that of the base with the block
    /// rocking on it, which is shorter than the base's own.
    fn longest_step(&self, point: &Point) -> f64 {
        let block = &self.scene.block;
        let mut square: f64 = 0.0;
        for side in [1.0, -1.0] {
            let b = block.arm(side);
            let (h2, b2) = (block.height * block.height, b * b);
            // Larger than in any position: P^2 and Q^2 at their largest, their sum fixed.
            let d = self.impact_inertia(b).min(self.least_inertia(b));
            let q2 = match self.scene.overturn {
                Overturn::CriticalAngle => b2,
                Overturn::QuarterTurn => b2 + h2,
            };
            let mut sum = 0.0;
            if self.scene.isolation.horizontal.is_some() {
                sum += (TAU / point.t_h).powi(2) * (1.0 + self.mu_h * (h2 + b2) / d);
            }
            if self.scene.isolation.vertical.is_some() {
                sum += (TAU / point.t_v).powi(2) * (1.0 + self.mu_v * q2 / d);
            }
            square = square.max(sum);
        }
        // Infinite where nothing oscillates.
        let longest = self.resolution.longest_step(TAU / square.sqrt());
        match &self.scene.isolation.horizontal {
            Some(law) if law.psi < 1.0 => {
                let yield_time = law.alpha_y * point.t_h / (TAU * f64::from(law.n));
                longest.min(self.resolution.longest_in_yield(yield_time))
            }
            _ => longest,
        }
    }

    /// The least that I/M - mu_h P^2 - mu_v Q^2 can be about a corner.
    fn least_inertia(&self, b: f64) -> f64 {
        let block = &self.scene.block;
        let radius2 = block.height * block.height + b * b;
        block.inertia / block.mass + radius2 * (1.0 - self.mu_h.max(self.mu_v))
    }

    /// The steps of a cell: the pulse's end is a step boundary.
    pub fn clock(&self, point: &Point) -> Clock {
        let longest = self.longest_step(point);
        let (forced, steps_forced, substeps) = match &self.scene.excitation {
            Excitation::Pulse(_) => {
                let pulse = TAU / point.omega;
                let forced = pulse.min(self.scene.t_max);
                let steps =
                    (forced / longest.min(self.resolution.longest_in_pulse(pulse))).ceil().max(1.0);
                (forced, steps, 1.0)
            }
            Excitation::Record(pair) => {
                let substeps = (pair.dt / longest).ceil().max(1.0);
                (pair.duration(), substeps * (pair.len() - 1) as f64, substeps)
            }
        };
        let free = self.scene.t_max - forced;
        // What rounding leaves of a duration is no step.
        let steps_free = (free / longest - 1.0e-9).ceil().max(0.0);
        Clock {
            step_forced: forced / steps_forced,
            step_free: if steps_free > 0.0 { free / steps_free } else { 0.0 },
            // `as` saturates; `Plan::new` refuses a scene that comes near.
            steps_forced: steps_forced as u32,
            substeps: substeps as u32,
            steps: (steps_forced + steps_free) as u32,
        }
    }

    /// A cell's numbers and the state that it starts in: at rest, the base in static equilibrium.
    pub fn cell<R: Real>(&self, point: &Point) -> (Cell<R>, State<R>) {
        let clock = self.clock(point);
        let mut cell = Cell::<R>::zeroed();
        let phase_step = match &self.scene.excitation {
            Excitation::Pulse(_) => clock.step_forced * point.omega / TAU,
            Excitation::Record(_) => 1.0 / f64::from(clock.substeps),
        };
        cell.amplitude_h = R::of(point.a_h);
        cell.amplitude_v = R::of(point.a_v);
        cell.phase_step = R::of(phase_step);
        cell.substeps = clock.substeps;
        cell.step_forced = R::of(clock.step_forced);
        cell.step_free = R::of(clock.step_free);
        cell.steps_forced = clock.steps_forced;
        cell.steps = clock.steps;
        if let Some(base) = &self.scene.isolation.horizontal {
            let omega_h = TAU / point.t_h;
            // (21): u_y = alpha_y PGA_h / omega_h^2; PGA_h is |A_h| for a pulse.
            let yield_force = base.alpha_y * point.a_h.abs();
            cell.post_yield = R::of(base.psi * omega_h * omega_h);
            cell.hysteretic = R::of((1.0 - base.psi) * yield_force);
            cell.damping_h = R::of(2.0 * base.xi_h * omega_h);
            cell.reach_h = R::of(omega_h * (1.0 + 4.0 * base.xi_h * base.xi_h).sqrt());
            let u_y = yield_force / (omega_h * omega_h);
            cell.yield_energy = R::of((1.0 - base.psi) * yield_force * u_y);
            // Without horizontal excitation u_y is zero, and so is the force that z carries.
            // So they may be taken to be where the number type does not hold 1/u_y.
            let inverse = R::of(omega_h * omega_h / yield_force);
            cell.inverse_yield = if inverse.to_f64().is_finite() { inverse } else { R::of(0.0) };
        }
        let mut state = State::<R>::zeroed();
        if let Some(base) = &self.scene.isolation.vertical {
            let omega_v = TAU / point.t_v;
            cell.stiffness_v = R::of(omega_v * omega_v);
            cell.damping_v = R::of(2.0 * base.xi_v * omega_v);
            cell.reach_v = R::of(omega_v * (1.0 + 4.0 * base.xi_v * base.xi_v).sqrt());
            let deflection = GRAVITY / (omega_v * omega_v);
            cell.deflection = R::of(deflection);
            state.motion.v = R::of(-deflection);
            state.max_v = R::of(deflection);
        }
        let tilt = self.scene.tilt;
        state.motion.phi = R::of(tilt);
        if tilt > 0.0 {
            state.mode = ROCKING_LEFT;
        } else if tilt < 0.0 {
            state.mode = ROCKING_RIGHT;
        }
        // A flight at the speed w lasts 2 w M D / (M g b): the corner with the shorter arm is the
        // quicker to land.
        let b = self.scene.block.arm(1.0).max(self.scene.block.arm(-1.0));
        let fall = GRAVITY * b / self.impact_inertia(b);
        let step = clock.step_forced.max(clock.step_free);
        cell.rest_speed = R::of(0.5 * fall * step / FLIGHTS_A_STEP);
        state.min_contact = R::of(GRAVITY);
        check_cell(&cell, &mut state);
        (cell, state)
    }

    /// What became of a cell whose run has ended in `state`.
    pub fn outcome<R: Real>(&self, point: &Point, state: &State<R>) -> Outcome {
        let clock = self.clock(point);
        let block = &self.scene.block;
        let (left, right) = (state.max_phi_left.to_f64(), state.max_phi_right.to_f64());
        let stood = state.uplifts == 0 && self.scene.tilt == 0.0;
        let stands = if stood { Class::FullContact } else { Class::Rocking };
        let (mut class, mut status) = match state.status {
            FINISHED => (stands, Status::Ok),
            PROVED => (stands, Status::Proved),
            OVERTURNED_LEFT => (Class::OverturnedLeft, Status::Ok),
            OVERTURNED_RIGHT => (Class::OverturnedRight, Status::Ok),
            EVENT_LIMIT => (Class::Unresolved, Status::EventLimit),
            _ => (Class::Unresolved, Status::Diverged),
        };
        if !state.motion.coordinates().iter().all(|x| x.to_f64().is_finite()) {
            (class, status) = (Class::Unresolved, Status::Diverged);
        }
        let mut zeta = (left / block.critical_angle(1.0)).max(right / block.critical_angle(-1.0));
        if class.overturned() {
            zeta = 1.0;
        }
        Outcome {
            class,
            impacts: state.impacts,
            uplifts: state.uplifts,
            t_end: if state.status == FINISHED {
                self.scene.t_max
            } else {
                clock.time(state.step, state.end_fraction.to_f64())
            },
            t_uplift: (state.uplifts > 0)
                .then(|| clock.time(state.uplift_step, state.uplift_fraction.to_f64())),
            zeta,
            max_phi_left: left,
            max_phi_right: right,
            max_u: state.max_u.to_f64(),
            max_v: state.max_v.to_f64(),
            min_contact: state.min_contact.to_f64(),
            friction: state.friction.to_f64(),
            status,
        }
    }
}
