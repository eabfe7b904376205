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
        for mut case in Grid::of(scene).corners() {
            if let (Some(rigid), Some(law)) = (plan.rigid_period(), &mut case.isolation.vertical) {
                // Stiffer cells run without the vertical direction.
                law.t_v = law.t_v.max(rigid);
            }
            let clock = plan.clock(&case);
            if f64::from(clock.steps) > MOST_STEPS {
                let problem = format!(
                    "{} s take more than {MOST_STEPS:e} steps at the shortest period; shorten t_max, \
                     or lock a direction as stiff as that",
                    case.t_max
                );
                return Err(SceneError::new("t_max", problem));
            }
        }
        Ok(plan)
    }
}
