//! The factors that a motion is run at for a comparison, and what each is for.

use crate::suites::wanted::WantedMotion;

/// Where what is asked of a motion lies among its factors.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shaken {
    /// As it is.
    pub(super) plain: usize,
    /// At the factors of the reserve.
    pub(super) scales: Vec<usize>,
    /// At the levels of the hazard's measure, and these.
    pub(super) levels: Vec<(usize, f64)>,
}

impl Shaken {
    /// Gives a motion the factors of a reserve, and those of levels.
    pub(super) fn of(
        motion: &mut WantedMotion,
        scales: &[f64],
        own: Vec<f64>,
        levels: Vec<f64>,
    ) -> Shaken {
        motion.at_factors(scales.iter().chain(&own).copied());
        Shaken {
            plain: motion.place_of(1.0),
            scales: scales.iter().map(|scale| motion.place_of(*scale)).collect(),
            levels: own.iter().map(|own| motion.place_of(*own)).zip(levels).collect(),
        }
    }
}

impl WantedMotion {
    /// Gives it factors, each once, the least first, 1 among them.
    fn at_factors(&mut self, factors: impl Iterator<Item = f64>) {
        self.factors = factors.chain([1.0]).collect();
        self.factors.sort_by(f64::total_cmp);
        self.factors.dedup();
    }

    /// The place of a factor that it has; the first place for one that it has not.
    fn place_of(&self, factor: f64) -> usize {
        self.factors.iter().position(|own| *own == factor).unwrap_or(0)
    }
}
