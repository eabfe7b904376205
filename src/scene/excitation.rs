//! What shakes the base.

use serde::{Deserialize, Serialize};

use super::range::Range;
use super::{SceneError, positive};

/// What shakes the base.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Excitation {
    /// A one-sine pulse in both directions, (22).
    Pulse(Pulse),
}

/// A one-sine pulse (22), swept over its frequency and its horizontal amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pulse {
    /// Omega, rad/s.
    pub omega: Range,
    /// A_h, m/s^2.
    pub a_h: Range,
    /// A_v, m/s^2.
    pub a_v: f64,
}

/// The pulse as written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct PulseText {
    /// Omega: circular frequency of the pulse, rad/s
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub omega: Option<Range>,
    /// A_h: horizontal amplitude of the pulse, m/s^2
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub a_h: Option<Range>,
    /// A_v: vertical amplitude of the pulse, m/s^2 [default: 0]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub a_v: Option<f64>,
}

/// A checked pulse.
pub(super) fn check(text: &PulseText) -> Result<Pulse, SceneError> {
    let missing = |key| SceneError::new(key, "missing; give a number or start:stop:count");
    let omega = text.omega.ok_or_else(|| missing("omega"))?;
    positive("omega", omega.least())?;
    let a_h = text.a_h.ok_or_else(|| missing("a_h"))?;
    let a_v = text.a_v.unwrap_or(0.0);
    if !a_v.is_finite() {
        return Err(SceneError::new("a_v", format!("{a_v} must be a finite number")));
    }
    Ok(Pulse { omega, a_h, a_v })
}
