//! The levels of an intensity measure that each motion of a suite is scaled to.

use crate::suites::entry::MOST_FACTOR;
use crate::suites::intensity::Intensity;
use crate::suites::wanted::WantedMotion;
use topple::scene::{Block, SceneError, Values};

/// Gives motions the factors that take them to levels of a measure; without levels they keep the factors that they have. What
/// is returned is the level of each motion at each of its factors.
///
/// # Errors
/// A level that is not above zero, a motion whose measure is zero, and one that a level scales by more than
/// [`MOST_FACTOR`].
pub fn scale(
    motions: &mut [WantedMotion],
    intensity: Intensity,
    levels: Option<&Values>,
    block: &Block,
) -> Result<Vec<Vec<f64>>, SceneError> {
    let refused = |key, problem| Err(SceneError { key, problem });
    let mut wanted: Option<Vec<f64>> = levels.map(|levels| levels.iter().collect());
    if let Some(levels) = &mut wanted {
        levels.sort_by(f64::total_cmp);
        if let Some(level) = levels.iter().find(|level| !(**level > 0.0 && level.is_finite())) {
            return refused("levels", format!("{level} is no level; give levels above 0"));
        }
    }
    let mut all = Vec::with_capacity(motions.len());
    for motion in motions {
        let own = intensity.of(&motion.pair, block);
        if !(own > 0.0 && own.is_finite()) {
            let problem = format!("{} of {} is {own}; leave the motion out", intensity, motion.id);
            return refused("im", problem);
        }
        match &wanted {
            None => {
                let level = |factor: &f64| own * intensity.growth(*factor);
                all.push(motion.factors.iter().map(level).collect());
            }
            Some(levels) => {
                motion.factors = levels.iter().map(|level| intensity.factor(level / own)).collect();
                let most = motion.factors.iter().copied().fold(0.0, f64::max);
                if most > MOST_FACTOR {
                    let level = levels.last().copied().unwrap_or_default();
                    let problem = format!(
                        "{intensity} = {level} scales {} by {most:.1e}, more than {MOST_FACTOR:e}; give lower levels",
                        motion.id
                    );
                    return refused("levels", problem);
                }
                all.push(levels.clone());
            }
        }
    }
    Ok(all)
}
