//! What is made of a record's components before they shake a base.

use serde::{Deserialize, Serialize};

use super::{Baseline, SceneError};

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

    /// The keys of numbers and their values, as far as they are given.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let all = [
            ("azimuth", self.azimuth),
            ("horizontal_azimuth", self.horizontal_azimuth),
            ("horizontal_2_azimuth", self.horizontal_2_azimuth),
            ("join_gap", self.join_gap),
            ("floor_period", self.floor_period),
            ("floor_damping", self.floor_damping),
            ("floor_factor", self.floor_factor),
        ];
        all.into_iter().filter_map(|(key, value)| value.map(|value| (key, value)))
    }

    /// Checks the numbers alone.
    ///
    /// # Errors
    /// The key of an invalid one.
    pub fn check(&self) -> Result<(), SceneError> {
        for (key, value) in self.given() {
            let (holds, must) = match key {
                "azimuth" | "horizontal_azimuth" | "horizontal_2_azimuth" => {
                    ((0.0..=360.0).contains(&value), "be from 0 to 360 degrees")
                }
                "join_gap" => ((0.0..=3600.0).contains(&value), "be from 0 to 3600 s"),
                "floor_period" => ((0.01..=20.0).contains(&value), "be from 0.01 to 20 s"),
                "floor_damping" => ((0.0..1.0).contains(&value), "be at least 0 and below 1"),
                _ => ((-10.0..=10.0).contains(&value), "be from -10 to 10"),
            };
            if !holds {
                return Err(SceneError::new(key, format!("{value} must {must}")));
            }
        }
        Ok(())
    }
}
