//! What is simulated: a block on a base, the excitation, and the grid of parameters.
//!
//! A scene is written as flags or as TOML ([`text`]), is checked once on its way into a
//! [`Scene`], and is believed from there on.

pub mod block;
pub mod excitation;
pub mod grid;
pub mod isolation;
pub mod range;
pub mod record;
pub mod text;

use std::f64::consts::FRAC_PI_2;

use serde::{Deserialize, Serialize};

pub use block::Block;
pub use excitation::{Excitation, Pulse};
pub use grid::{Grid, Point};
pub use isolation::Isolation;
pub use range::Range;

/// g, m/s^2.
pub const GRAVITY: f64 = 9.81;

/// When a block counts as overturned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Overturn {
    /// |phi| reaches arctan((B +- e)/H), the paper's convention (section 2.6).
    CriticalAngle,
    /// |phi| reaches 90 degrees (Zhang & Makris 2001).
    QuarterTurn,
}

/// A checked scene. SI units everywhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// One line for figures and manifests.
    pub title: String,
    /// The block.
    pub block: Block,
    /// The base that it stands on.
    pub isolation: Isolation,
    /// What shakes the base.
    pub excitation: Excitation,
    /// Simulated time, s.
    pub t_max: f64,
    /// phi at the start, rad; other than zero, the block begins tilted, at rest about a corner.
    pub tilt: f64,
    /// When the block counts as overturned.
    pub overturn: Overturn,
    /// Friction coefficient of the contact: cells that ask for more are marked, for the model knows
    /// no sliding.
    pub friction: Option<f64>,
    /// eta_phi given in place of the law of impact (no isolation only).
    pub restitution: Option<f64>,
}

/// What is wrong with a scene: the key (a flag of the same name on the command line), and one
/// clause that says what is wrong and what to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct SceneError {
    /// The key at fault, as written in TOML: `t_h`.
    pub key: &'static str,
    /// What is wrong and what to do.
    pub problem: String,
}

impl Scene {
    /// The ranges that the scene's grid is made of, those of a single value among them.
    pub fn axes_mut(&mut self) -> impl Iterator<Item = &mut Range> {
        let (horizontal, vertical) =
            (self.isolation.horizontal.as_mut(), self.isolation.vertical.as_mut());
        let periods = [horizontal.map(|law| &mut law.t_h), vertical.map(|law| &mut law.t_v)];
        let swept = match &mut self.excitation {
            Excitation::Pulse(pulse) => [Some(&mut pulse.omega), Some(&mut pulse.a_h)],
            Excitation::Record(_) => [None, None],
        };
        periods.into_iter().chain(swept).flatten()
    }

    /// |phi| at which the block counts as overturned about a corner, +1 the left, -1 the right, rad.
    pub fn overturning_angle(&self, side: f64) -> f64 {
        match self.overturn {
            Overturn::CriticalAngle => self.block.critical_angle(side),
            Overturn::QuarterTurn => FRAC_PI_2,
        }
    }
}

impl SceneError {
    pub(crate) fn new(key: &'static str, problem: impl Into<String>) -> SceneError {
        SceneError { key, problem: problem.into() }
    }

    /// The flag of the same name: `--t-h`.
    pub fn flag(&self) -> String {
        format!("--{}", self.key.replace('_', "-"))
    }
}

/// `value` if it is finite and positive.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<f64, SceneError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(SceneError::new(key, format!("{value} must be a positive number")))
}

/// `value` if it is in `[low, high]`.
pub(crate) fn within(
    key: &'static str,
    value: f64,
    low: f64,
    high: f64,
) -> Result<f64, SceneError> {
    if value >= low && value <= high {
        return Ok(value);
    }
    Err(SceneError::new(key, format!("{value} must lie between {low} and {high}")))
}
