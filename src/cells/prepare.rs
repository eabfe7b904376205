//! From a scene to its plan; a scene whose cells take too many steps is refused.

use super::clock::Resolution;
use super::plan::Plan;
use crate::scene::{Grid, Scene, SceneError, positive};

/// Most steps that a cell may take: some minutes of one core.
pub const MOST_STEPS: f64 = 1.0e9;

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

    /// At T_v = 0.05 s a period has 160 steps in f32 and 640 in f64, a second 3,200 and 12,800: those are counted that are
    /// taken.
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
        // A block makes the base stiffer by some percent.
        let most = |t_max| [f32, f64, twice, thrice].map(|method| accepted(t_max, method));
        assert_eq!(most(1.0e5), [true, false, false, false]);
        assert_eq!(most(5.0e4), [true, true, false, false]);
        assert_eq!(most(2.5e4), [true, true, true, false]);
        assert_eq!(most(1.2e4), [true; 4]);
    }
}
