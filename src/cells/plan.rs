//! A scene that is ready to run: its step lengths, its shortcuts, and the data with which each cell begins. A scene
//! whose cells take too many steps is refused.

use std::sync::Arc;

use bytemuck::Zeroable;

use super::at_rest::at_rest;
use super::body::{Body, body_parameters};
use super::clock::{Clock, Resolution};
use super::clock_parts::ClockRule;
use super::contact::motion_cache::MotionCache;
use super::laws::Laws;
use super::reader::Reader;
use super::samples::Samples;
use super::shortcuts::Shortcuts;
use crate::model::asked::Asked;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Drive, Ground, Horizontal, Steps, Vertical};
use crate::model::isolation::Variant;
use crate::model::precision::Precision;
use crate::model::pulse::Shape;
use crate::model::real::Real;
use crate::scene::{Case, Excitation, Grid, Parameter, Scene, SceneError, positive};
use crate::stepping::outcome::Outcome;
use crate::stepping::state::State;

/// Most steps that a cell may take: they take some minutes on one core.
pub const MOST_STEPS: f64 = 1.0e9;

/// A vertical isolation whose period is below this share of the time step of a record is rigid for that record, which
/// contains no period below two steps.
pub const RIGID_SHARE: f64 = 0.2;

/// A scene that is ready for its cells.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The scene; of a part, the scene with the directions locked that the part locks.
    pub scene: Scene,
    /// How finely its cells are stepped.
    pub resolution: Resolution,
    /// Shortcuts that cannot change the result.
    pub shortcuts: Shortcuts,
    /// The largest and least values that are requested: others are not searched for, and are NaN in the outcomes.
    pub asked: Asked,
    /// The laws that all its cells have.
    pub(crate) laws: Laws,
    /// The cells differ in their body.
    bodies: bool,
    /// The pulse of some cell has more than one cycle.
    cycles: bool,
    /// The cache of full-contact motions, shared by all batches.
    pub(crate) motion_cache: Arc<MotionCache>,
    /// The samples of the record, shared by all batches.
    samples: Arc<Samples>,
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
        let plan = Plan::unchecked(scene, resolution);
        plan.check_steps()?;
        Ok(plan)
    }

    /// The plan of a scene, not yet checked for the number of its steps.
    fn unchecked(scene: &Scene, resolution: Resolution) -> Plan {
        let laws = Laws::GROUND;
        let (copy, shortcuts, motion_cache) = (scene.clone(), Shortcuts::ALL, Arc::default());
        let bodies = Grid::of(scene).sweeps(&body_parameters());
        let most = scene.numbers.get(Parameter::Cycles).map_or(1.0, |values| values.ends().1);
        let cycles = most > 1.0;
        let mut plan = Plan {
            scene: copy,
            resolution,
            shortcuts,
            asked: Asked::ALL,
            laws,
            bodies,
            cycles,
            motion_cache,
            samples: Arc::default(),
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

    /// The plan of a sweep of which only these largest and least values are requested.
    pub fn asking(&self, asked: Asked) -> Plan {
        Plan { asked, ..self.clone() }
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

    /// True for a cell whose vertical isolation is rigid for the record, and is therefore locked.
    pub fn locks_vertical(&self, case: &Case) -> bool {
        let t_v = case.isolation.vertical.map(|law| law.t_v);
        t_v.is_some_and(|t_v| self.rigid_period().is_some_and(|rigid| t_v < rigid))
    }

    /// A cell with the directions locked that are locked in this plan.
    pub(crate) fn locked(&self, case: &Case) -> Case {
        let mut case = *case;
        if !self.scene.isolation.moves_h() {
            case.isolation.horizontal = None;
            case.isolation.stop = None;
        }
        if !self.scene.isolation.moves_v() {
            case.isolation.vertical = None;
        }
        case
    }

    /// A cell as it is run: where its vertical isolation is that stiff, without the vertical direction.
    pub(crate) fn as_run(&self, case: &Case) -> Case {
        let mut case = self.locked(case);
        if self.locks_vertical(&case) {
            case.isolation.vertical = None;
        }
        case
    }

    /// The model that a cell runs.
    pub(crate) fn laws_of(&self, case: &Case) -> Laws {
        Laws::of(&self.locked(case).isolation, self.shortcuts)
    }

    /// The same with the horizontal direction locked.
    pub(crate) fn without_horizontal(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation = plan.scene.isolation.without_horizontal();
        plan.laws = plan.laws.without_horizontal();
        plan
    }

    /// The same with the vertical direction locked.
    pub(crate) fn without_vertical(&self) -> Plan {
        let mut plan = self.clone();
        plan.scene.isolation = plan.scene.isolation.without_vertical();
        plan.laws = plan.laws.without_vertical();
        plan
    }

    /// The samples of the record, or two zeros where there is none.
    pub fn record<R: Real>(&self) -> Arc<Vec<Ground<R>>> {
        match &self.scene.excitation {
            Excitation::Record(pair) => self.samples.of(pair),
            Excitation::Pulse(_) => Arc::new(vec![Ground::zeroed(); 2]),
        }
    }

    /// The numbers of a cell's equations that come from its block and the masses of its base.
    pub fn model<R: Real>(&self, case: &Case) -> Model<R> {
        Body::of(&self.locked(case)).model()
    }

    /// The variant of the model that the scene needs; of a part, the one that all its cells need.
    pub fn variant(&self) -> Variant {
        let Laws { moves: [isolated_h, isolated_v], yields, bouc_wen_n, follows, stops, hardens } =
            self.laws;
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
            kinks: self.resolution.kinks && (yields || stops),
            yields,
            // The energy proves nothing for a base that is not passive.
            certificate: self.shortcuts.certificate && !follows,
            asked: Asked { stops: self.asked.stops && stops, ..self.asked },
            bodies: self.bodies,
            bouc_wen_n,
            devices: follows || stops || hardens,
            follows,
            stops,
            hardens,
        }
    }

    /// True where motions in full contact may be shared: the largest and least values that they do not provide are
    /// not requested, and their bounds hold.
    pub fn shares_contact(&self) -> bool {
        self.laws.shares_contact() && !self.asked.accelerations
    }

    /// True where blocks that stand take long steps.
    pub fn takes_long_steps(&self) -> bool {
        let recorded = self.scene.excitation.record().is_some();
        recorded && self.shortcuts.full_contact && self.shares_contact()
    }

    /// The rule from which the clocks of its cells follow.
    pub(crate) fn clock_rule(&self) -> ClockRule<'_> {
        let Plan { resolution, shortcuts, .. } = *self;
        ClockRule { resolution, shortcuts, excitation: &self.scene.excitation }
    }

    /// The steps of a cell: the pulse's end is a step boundary.
    pub fn clock(&self, case: &Case) -> Clock {
        let (case, rule) = (self.locked(case), self.clock_rule());
        let body = Body::of(&case);
        rule.clock_of(&rule.swing_h(&case, &body), &rule.swing_v(&case, &body), &rule.span(&case))
    }

    /// A cell's numbers and the state that it starts in: at rest, the base in static equilibrium. Its body is number 0.
    pub fn cell<R: Real>(&self, case: &Case) -> (Cell<R>, State<R>) {
        let case = self.locked(case);
        let body = Body::of(&case);
        let omega = self.clock_rule().span(&case).omega;
        let cell = Cell {
            horizontal: Horizontal::of(&case, &body),
            vertical: Vertical::of(&case, &body),
            drive: Drive::of(&case, None),
            steps: Steps::of(omega, &self.clock(&case), body.fall()),
            body: 0,
            padding: 0,
        };
        let state = at_rest(cell.finite(), cell.drive.tilt);
        (cell, state)
    }

    /// The outcome of a cell whose last state is `state`.
    pub fn outcome<R: Real>(&self, case: &Case, state: &State<R>) -> Outcome {
        Reader::of(case, self.asked).outcome(&self.clock(case), state)
    }

    /// Frees the motions and the samples that its cells share, at the end of a sweep.
    pub fn forget(&self) {
        self.motion_cache.clear();
        self.samples.clear();
    }

    /// Checks the steps that its cells take.
    ///
    /// # Errors
    /// The key `t_max`: a duration of more than [`MOST_STEPS`] steps.
    pub(crate) fn check_steps(&self) -> Result<(), SceneError> {
        for mut case in Grid::of(&self.scene).corners() {
            if let (Some(rigid), Some(law)) = (self.rigid_period(), &mut case.isolation.vertical) {
                // Stiffer cells run without the vertical direction.
                law.t_v = law.t_v.max(rigid);
            }
            let clock = self.clock(&case);
            if f64::from(clock.steps) > MOST_STEPS {
                let problem = format!(
                    "{} s take more than {MOST_STEPS:e} steps at the shortest period; shorten t_max, \
                     or lock a direction as stiff as that",
                    case.t_max
                );
                return Err(SceneError::new("t_max", problem));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::model::precision::Precision;
    use crate::scene::{Parameter, SceneBuilder};
    use crate::sweep::settings::Method;

    /// At T_v = 0.05 s a period has 160 steps in f32 and 640 in f64, a second 3,200 and 12,800: the limit counts the
    /// steps that are taken.
    #[test]
    fn steps_are_bounded_as_they_are_taken() {
        let accepted = |t_max: f64, method: Method| {
            let scene = SceneBuilder::object(1)
                .with(Parameter::TH, 2.0)
                .with(Parameter::TV, 0.05)
                .with(Parameter::Omega, 5.0)
                .with(Parameter::AH, 5.0)
                .with(Parameter::TMax, t_max);
            let plan = method.plan(&scene.check().unwrap());
            plan.as_ref().map_err(|error| assert_eq!(error.key, "t_max")).is_ok()
        };
        let f32 = Method::default();
        let f64 = Method { precision: Precision::F64, ..f32 };
        let (twice, thrice) = (Method { resolve: true, ..f32 }, Method { repair: true, ..f32 });
        // A block makes the base stiffer by a few percent.
        let most = |t_max| [f32, f64, twice, thrice].map(|method| accepted(t_max, method));
        assert_eq!(most(1.0e5), [true, false, false, false]);
        assert_eq!(most(5.0e4), [true, true, false, false]);
        assert_eq!(most(2.5e4), [true, true, true, false]);
        assert_eq!(most(1.2e4), [true; 4]);
    }
}
