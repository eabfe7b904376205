//! The grids of a view: coarse, fine and finest, each with its cells among those of the next.

use super::asked::{Flat, axes};
use super::refused::Refused;
use topple::scene::Parameter;
use topple::scene::parameters::Legal;

/// Gaps along an axis of the coarse picture at most.
const COARSE: u32 = 64;
/// Cells along an axis at least.
const LEAST: u32 = 2;
/// Cells along an axis at most.
pub const MOST: u32 = 2049;

/// The grids of a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stages {
    count: [u32; 2],
    /// How often the gaps of the coarse picture are halved down to the finest.
    pub levels: u32,
}

/// True of a number that is whole: between two of its values there is none.
fn is_whole(parameter: Parameter) -> bool {
    matches!(parameter.entry().legal, Legal::Whole(..))
}

impl Stages {
    /// Those of a view that asks for a given number of cells along its axes, about. Along whole numbers there is one stage alone.
    ///
    /// # Errors
    /// The keys `x` and `y`.
    pub fn of(scene: &Flat, count: [u32; 2]) -> Result<Stages, Refused> {
        let whole = axes(scene)?.into_iter().any(is_whole);
        let count = count.map(|count| count.clamp(LEAST, MOST));
        let most = count.into_iter().max().unwrap_or(1) - 1;
        let levels = most.div_ceil(COARSE).next_power_of_two().ilog2();
        Ok(Stages { count, levels: if whole { 0 } else { levels } })
    }

    /// Cells along both axes of the stage whose gaps are those of the finest, doubled a given number of times.
    pub fn count(&self, doubled: u32) -> [u32; 2] {
        self.count.map(|count| ((count - 1).next_multiple_of(1 << self.levels) >> doubled) + 1)
    }
}

/// Cells along both axes, so many at most, but for whole numbers.
///
/// # Errors
/// The keys `x` and `y`.
pub fn at_most(scene: &Flat, count: [u32; 2], most: u32) -> Result<[u32; 2], Refused> {
    let axes = axes(scene)?;
    let of = |k: usize| if is_whole(axes[k]) { count[k] } else { count[k].min(most) };
    Ok([0, 1].map(|k| of(k).clamp(LEAST, MOST)))
}
