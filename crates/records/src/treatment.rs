//! What is made of a record's components before they shake a base.

use serde::{Deserialize, Serialize};

use super::Baseline;

/// Zeros between two records that follow one another by default, s.
pub const GAP: f64 = 30.0;
/// Damping of a floor's oscillator by default.
pub const DAMPING: f64 = 0.05;

/// What is made of a record, as written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Treatment {
    /// Azimuth to which two horizontal components are turned, degrees from north over east
    #[serde(skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<f64>,
    /// Azimuth of the horizontal component, where its file does not tell
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizontal_azimuth: Option<f64>,
    /// Azimuth of the second one, where its file does not tell
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizontal_2_azimuth: Option<f64>,
    /// Zeros between the record and the one that follows it, s
    #[serde(skip_serializing_if = "Option::is_none")]
    pub join_gap: Option<f64>,
    /// Period of the floor's oscillator, s
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_period: Option<f64>,
    /// Its damping, as a share of the critical one
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_damping: Option<f64>,
    /// Factor on its acceleration relative to the ground
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_factor: Option<f64>,
    /// What is subtracted from the velocity of each component
    #[serde(skip_serializing_if = "Option::is_none")]
    pub baseline: Option<Baseline>,
}

impl Treatment {
    /// True where nothing is made of a record.
    pub fn is_none(&self) -> bool {
        *self == Treatment::default()
    }
}
