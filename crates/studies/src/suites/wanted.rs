//! The motions that a scene is swept under: those of a suite, in one direction or both, at some levels.

use super::read::Suite;
use topple::scene::record::Pair;
use topple::scene::{Excitation, Numbers, Parameter, Scene, SceneBuilder, SceneError, excitation};

/// A motion, and the factors that it is swept at.
#[derive(Debug, Clone, PartialEq)]
pub struct WantedMotion {
    /// The motion's id.
    pub id: String,
    /// How much it counts.
    pub weight: f64,
    /// Both components, scaled as the scene says: as they are shown and measured.
    pub pair: Pair,
    /// The same as the suite has them. A run multiplies each sample of these once, by the factors of both: of one factor all commands have
    /// the same bits, whether it is the scene's, a level's or a reserve's.
    pub ground: Pair,
    /// Factors on both: a level each.
    pub factors: Vec<f64>,
    /// Numbers of the scene that are others under it.
    pub settings: Vec<(Parameter, f64)>,
}

impl WantedMotion {
    /// A scene, which has no excitation of its own, under the motion.
    ///
    /// # Errors
    /// Numbers that make no sense.
    pub fn under(&self, scene: &SceneBuilder) -> Result<Scene, SceneError> {
        let shaken = Excitation::Record(self.pair.clone());
        if self.settings.is_empty() {
            return scene.check_under(shaken);
        }
        let mut changed = scene.check_under(shaken)?;
        for (parameter, value) in &self.settings {
            changed.set(*parameter, *value);
        }
        changed.check()?;
        Ok(changed)
    }

    /// Each motion at every point of some numbers, one after the other.
    pub fn spread<'a>(
        motions: &[WantedMotion],
        parameters: &[Parameter],
        points: impl Iterator<Item = &'a Vec<f64>> + Clone,
    ) -> Vec<WantedMotion> {
        let at = |motion: &WantedMotion, point: &Vec<f64>| {
            let settings = parameters.iter().copied().zip(point.iter().copied()).collect();
            WantedMotion { settings, ..motion.clone() }
        };
        motions
            .iter()
            .flat_map(|motion| points.clone().map(move |point| at(motion, point)))
            .collect()
    }

    /// The motions of a suite as they are, scaled as a scene's numbers say; with `both_directions` each a second
    /// time with its horizontal component reversed.
    pub fn of_suite(suite: &Suite, numbers: &Numbers, both_directions: bool) -> Vec<WantedMotion> {
        let mut motions = Vec::new();
        for (entry, motion) in suite.motions() {
            // A factor of the scene is on the motion as the suite has it, scaled by its list or not.
            let own = Pair { factor: 1.0, ..motion.pair.clone() };
            let pair = excitation::scaled(own.clone(), numbers);
            let (weight, factors) = (entry.weight, vec![1.0]);
            let settings = Vec::new();
            let (id, ground) = (entry.id.clone(), own);
            let motion = WantedMotion { id, weight, pair, ground, factors, settings };
            if both_directions {
                let id = format!("{} reversed", motion.id);
                motions.push(WantedMotion {
                    id,
                    pair: motion.pair.clone().reversed(),
                    ground: motion.ground.clone().reversed(),
                    ..motion.clone()
                });
            }
            motions.push(motion);
        }
        motions
    }
}
