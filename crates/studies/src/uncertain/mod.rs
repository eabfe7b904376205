//! Numbers that are not known: how they are distributed, points that fill their distributions evenly, scenes at these
//! points, and how much of a result each number explains.
//!
//! ```text
//! distributions -> points -> scenes -> (sweeps) -> probabilities
//!               -> Saltelli's design -> outputs -> Sobol indices
//! ```

pub(crate) mod ensemble;
pub mod indices;
pub mod pixel;
pub mod points;
pub mod probability;
pub(crate) mod varied;

pub use ensemble::Ensemble;
pub use indices::{Design, Explained, Index, indices};
pub use probability::{Probabilities, Uncertainty};
pub use varied::Varied;

use topple::scene::{Scene, SceneError};

/// Points of numbers that are not known by default, under a suite.
pub const SAMPLES: u32 = 64;
/// Most of them.
const MOST_SAMPLES: u32 = 1 << 16;

/// Refuses too few or too many points under a suite.
///
/// # Errors
/// The key `samples`.
pub(crate) fn check_samples(samples: u32) -> Result<(), SceneError> {
    match (2..=MOST_SAMPLES).contains(&samples) {
        true => Ok(()),
        false => {
            Err(SceneError::new("samples", format!("{samples} is not in 2 to {MOST_SAMPLES}")))
        }
    }
}

/// So many points of numbers of a scene that are not known, from a seed, each with a value of every number. The scene at each is
/// checked.
pub(crate) fn checked_points(
    scene: &Scene,
    vary: &[Varied],
    (samples, seed): (usize, u32),
    force: bool,
) -> Result<Vec<Vec<f64>>, SceneError> {
    let ensemble = Ensemble::of(scene, vary, force)?;
    let shares = points::shares(vary.len(), samples, seed);
    let points: Vec<Vec<f64>> = shares.iter().map(|shares| points::values(vary, shares)).collect();
    ensemble.scenes(&points).map(|_| ())?;
    Ok(points)
}
