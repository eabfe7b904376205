//! The flags of what is not known.

use topple::scene::{Scene, SceneError};
use topple_studies::uncertain::probability::MOST_SAMPLES;
use topple_studies::uncertain::{Uncertainty, Varied};

use super::numbers::seed;

/// Flags of a map that a probability map does not have: nothing of it is saved until it is done.
pub const NOT_BESIDE: [&str; 10] = [
    "resume",
    "keep_every",
    "tile",
    "files",
    "columns",
    "repair",
    "refine",
    "sharpness",
    "spectrum",
    "dry_run",
];
/// Sweeps where no count is given.
const SAMPLES: u32 = 64;

/// The numbers of a map that are not known.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Uncertainty")]
pub struct UncertainFlags {
    /// Distribution of a number that is not known: KEY=normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA); two more
    /// numbers LOW,HIGH cut it off. Writes probabilities instead of the map
    #[arg(long, value_name = "KEY=DIST", conflicts_with_all = NOT_BESIDE)]
    vary: Vec<Varied>,
    /// Vary the axes over the pixel of each cell; writes probabilities instead of the map
    #[arg(long, conflicts_with_all = NOT_BESIDE)]
    pixel: bool,
    /// Number of sweeps for the probabilities, best a power of two [default: 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=i64::from(MOST_SAMPLES)))]
    samples: Option<u32>,
    /// Seed of the sampling, at most 4294967295 [default: 0]
    #[arg(long, value_name = "N", value_parser = seed)]
    seed: Option<u32>,
}

impl UncertainFlags {
    /// True where probabilities are requested.
    pub fn asked(&self) -> bool {
        self.pixel || !self.vary.is_empty()
    }

    /// The numbers that are not known.
    pub fn uncertainty(&self) -> Uncertainty {
        Uncertainty {
            vary: self.vary.clone(),
            pixel: self.pixel,
            samples: self.samples.unwrap_or(SAMPLES),
            seed: self.seed.unwrap_or(0),
        }
    }

    /// Takes over what an earlier run did not know, where no flag says otherwise.
    pub fn adopt(&mut self, earlier: Uncertainty) {
        if !self.asked() {
            (self.vary, self.pixel) = (earlier.vary, earlier.pixel);
        }
        self.samples.get_or_insert(earlier.samples);
        self.seed.get_or_insert(earlier.seed);
    }

    /// Refuses what cannot be.
    ///
    /// # Errors
    /// Samples of nothing, and those of [`Uncertainty::check`].
    pub fn check(&self, scene: &Scene, force: bool) -> Result<(), SceneError> {
        for (given, key) in [(self.samples.is_some(), "samples"), (self.seed.is_some(), "seed")] {
            if given && !self.asked() {
                let problem = "means nothing where all is known; give --vary or --pixel too".into();
                return Err(SceneError { key, problem });
            }
        }
        if !self.asked() {
            return Ok(());
        }
        self.uncertainty().check(scene, force).map(|_| ())
    }
}
