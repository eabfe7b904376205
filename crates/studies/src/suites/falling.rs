//! Where the ground accelerates downwards by more than g: a block would leave its base there, and the model has no loss of contact.

use super::swept::SuiteJob;
use super::wanted::WantedMotion;
use topple::scene::{GRAVITY, Parameter, Scene};

/// Levels, or factors, at which motions accelerate the ground downwards by more than g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Falling {
    /// The lowest of them.
    pub from: f64,
    /// How many there are.
    pub levels: usize,
    /// Of so many in all.
    pub of_levels: usize,
    /// The lowest at which half of the motions or more do so; none where fewer do at each.
    pub half: Option<f64>,
    /// Runs that do so, at all levels together.
    pub runs: usize,
    /// Of so many.
    pub of_runs: usize,
}

impl Falling {
    /// Those among runs, each with its level and the largest downward acceleration of the ground, m/s^2; none where no run has more
    /// than g.
    pub fn of(runs: impl Iterator<Item = (f64, f64)>) -> Option<Falling> {
        let mut runs: Vec<(f64, bool)> = runs.map(|(level, a)| (level, a > GRAVITY)).collect();
        runs.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let levels: Vec<&[(f64, bool)]> = runs.chunk_by(|(a, _), (b, _)| a == b).collect();
        let falls = |level: &[(f64, bool)]| level.iter().filter(|(_, falls)| *falls).count();
        let falling = || levels.iter().filter(|level| falls(level) > 0);
        let by_half = levels.iter().find(|level| 2 * falls(level) >= level.len());
        Some(Falling {
            from: falling().next()?[0].0,
            levels: falling().count(),
            of_levels: levels.len(),
            half: by_half.map(|level| level[0].0),
            runs: falls(&runs),
            of_runs: runs.len(),
        })
    }
}

impl SuiteJob {
    /// The largest downward acceleration of the ground under each motion at each of its factors, m/s^2; of several scales or peaks of
    /// the scene at the largest.
    pub fn downward(&self) -> Vec<Vec<f64>> {
        let of = |(wanted, scene): &(WantedMotion, Scene)| {
            let WantedMotion { pair, factors, .. } = wanted;
            let several = |one: Parameter| scene.numbers.get(one).filter(|own| own.count() > 1);
            let of_cells = match (several(Parameter::Scale), several(Parameter::Pga)) {
                (Some(scales), _) => scales.ends().1,
                (None, Some(peaks)) => peaks.ends().1 / pair.pga_h,
                (None, None) => 1.0,
            };
            let most = pair.vertical.iter().fold(0.0, |most: f64, a| most.max(-a));
            factors.iter().map(|factor| factor * of_cells * most).collect()
        };
        self.all.iter().map(of).collect()
    }
}
