//! A parameter whose value is not known: `eccentricity=normal(0.1,0.02)`.

use std::fmt;
use std::str::FromStr;

use serde::de::{Deserialize, Deserializer, Error};
use serde::{Serialize, Serializer};

use crate::statistics::distribution::Form;
use crate::statistics::{Distribution, DistributionError};
use topple::scene::parameters::Legal;
use topple::scene::shown::shown;
use topple::scene::{Parameter, Scene, SceneError};

/// Half the distance between two numbers that the sequence of [`points`](super::points) can give: no point lies on an edge
/// of the box, and no smaller share is ever drawn at either end of a distribution.
pub(super) const LEAST_SHARE: f64 = 1.0 / 16_777_216.0;

/// A parameter, and the distribution of its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Varied {
    /// The parameter.
    pub parameter: Parameter,
    /// How its values are distributed.
    pub distribution: Distribution,
}

/// Why a text is no parameter with a distribution.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum VariedError {
    /// Not KEY=DISTRIBUTION.
    #[error("'{0}' is no KEY=DISTRIBUTION, as in eccentricity=normal(0.1,0.02)")]
    Text(String),
    /// A key that no parameter has.
    #[error("'{0}' is no number of a scene; keys are named as flags are: t_h or t-h, eccentricity")]
    Key(String),
    /// No distribution.
    #[error("{0}: {1}")]
    Distribution(&'static str, DistributionError),
}

impl Varied {
    /// Its name and its distribution in words: `H, uniform from 0.6 to 1.3 m`.
    pub fn words(&self) -> String {
        let entry = self.parameter.entry();
        let unit = if entry.unit.is_empty() { String::new() } else { format!(" {}", entry.unit) };
        let Distribution { form, cut } = self.distribution;
        let how = match form {
            Form::Normal { mean, deviation } => {
                format!("normal, mean {mean}{unit}, standard deviation {deviation}{unit}")
            }
            Form::Uniform { low, high } => format!("uniform from {low} to {high}{unit}"),
            Form::Lognormal { median, beta } => {
                format!(
                    "lognormal, median {median}{unit}, standard deviation of its logarithm {beta}"
                )
            }
        };
        let cut = cut.map(|(low, high)| format!(", cut off at {low} and {high}{unit}"));
        format!("{}, {how}{}", entry.symbol, cut.unwrap_or_default())
    }

    /// A scene without the numbers that vary: what of it is fixed. It is to be read, not run.
    pub fn fixed(scene: &Scene, varied: &[Varied]) -> Scene {
        let mut fixed = scene.clone();
        varied.iter().for_each(|one| fixed.numbers.remove(one.parameter));
        fixed
    }

    /// Checks that the values that are drawn are such as the parameter may have; `force` accepts improbable ones.
    ///
    /// # Errors
    /// The share of the values outside, and what to do.
    pub fn check(&self, force: bool) -> Result<(), SceneError> {
        let entry = self.parameter.entry();
        let refused = |problem: String| Err(SceneError::new("vary", format!("{self}: {problem}")));
        // One that was made, not read, may be none.
        if let Err(error) = self.distribution.check() {
            return Err(SceneError::new("vary", format!("{}: {error}", entry.key)));
        }
        if let Legal::Whole(..) = entry.legal {
            return refused(format!(
                "{} is a whole number, and a distribution has others; sweep it as a list",
                entry.key
            ));
        }
        let ((low, high), _) = entry.legal.ends();
        let outside = |low, high| {
            let (below, above) = self.distribution.outside(low, high);
            (below.max(above) > LEAST_SHARE).then_some(percent(below + above))
        };
        let (name, [first, second]) = (self.distribution.name(), self.distribution.numbers());
        let remedy = format!("cut it off, as {name}({first},{second},LOW,HIGH)");
        if let Some(share) = outside(low, high) {
            return refused(format!(
                "{share} % of its values lie outside the range, for {} must {}; {remedy}",
                entry.key, entry.legal
            ));
        }
        let (least, most) = entry.plausible;
        let (low, high) = (if low < 0.0 { -most } else { least }, most);
        match outside(low, high).filter(|_| !force) {
            Some(share) => refused(format!(
                "{share} % of its values are not plausible ({low} to {high}; {}); {remedy}, or `force` accepts \
                 them",
                entry.perhaps
            )),
            None => Ok(()),
        }
    }
}

impl FromStr for Varied {
    type Err = VariedError;

    fn from_str(text: &str) -> Result<Varied, VariedError> {
        let (key, distribution) =
            text.split_once('=').ok_or_else(|| VariedError::Text(shown(text)))?;
        let key = key.trim();
        let parameter = Parameter::of_key(&key.replace('-', "_"))
            .ok_or_else(|| VariedError::Key(shown(key)))?;
        match distribution.parse() {
            Ok(distribution) => Ok(Varied { parameter, distribution }),
            Err(error) => Err(VariedError::Distribution(parameter.key(), error)),
        }
    }
}

impl fmt::Display for Varied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.parameter.key(), self.distribution)
    }
}

impl Serialize for Varied {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Varied {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Varied, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(Error::custom)
    }
}

/// A share in percent, with two digits however small it is.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let decimals = (1.0 - percent.log10().floor()).clamp(1.0, 12.0) as usize;
    format!("{percent:.decimals$}")
}
