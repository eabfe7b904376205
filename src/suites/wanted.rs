//! The motions that a scene is swept under: those of a suite, in one direction or both, at some levels.

use super::read::Suite;
use crate::scene::record::Pair;
use crate::scene::{Numbers, excitation};

/// A motion, and the factors that it is swept at.
#[derive(Debug, Clone, PartialEq)]
pub struct WantedMotion {
    /// The motion's id.
    pub id: String,
    /// How much it counts.
    pub weight: f64,
    /// Both components.
    pub pair: Pair,
    /// Factors on both: a level each.
    pub factors: Vec<f64>,
}

impl WantedMotion {
    /// The motions of a suite as they are, scaled as a scene's numbers say; with `both_directions` each a second
    /// time with its horizontal component reversed.
    pub fn of_suite(suite: &Suite, numbers: &Numbers, both_directions: bool) -> Vec<WantedMotion> {
        let mut motions = Vec::new();
        for (entry, motion) in suite.motions() {
            let pair = excitation::scaled(motion.pair.clone(), numbers);
            let (weight, factors) = (entry.weight, vec![1.0]);
            let motion = WantedMotion { id: entry.id.clone(), weight, pair, factors };
            if both_directions {
                let id = format!("{} reversed", motion.id);
                motions.push(WantedMotion {
                    id,
                    pair: motion.pair.clone().reversed(),
                    ..motion.clone()
                });
            }
            motions.push(motion);
        }
        motions
    }
}
