//! What shakes the base.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::range::Range;
use super::record::read::{self, Told};
use super::record::{Pair, Units};
use super::{SceneError, positive};

/// What shakes the base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Excitation {
    /// A one-sine pulse in both directions, (22).
    Pulse(Pulse),
    /// A ground-motion record.
    Record(Pair),
}

/// A one-sine pulse (22), swept over its frequency and its horizontal amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
pub(super) fn check_pulse(text: &PulseText) -> Result<Pulse, SceneError> {
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

/// The record as written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct RecordText {
    /// Horizontal record: AT2, COSMOS, CSMIP, SMC, K-NET, ESM, one or two columns [default: a
    /// synthetic pair]
    #[arg(long, value_name = "FILE")]
    pub horizontal: Option<PathBuf>,
    /// Vertical record, positive up
    #[arg(long, value_name = "FILE")]
    pub vertical: Option<PathBuf>,
    /// Time between samples, s, where a file does not tell
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub dt: Option<f64>,
    /// Units of the values, where a file does not tell
    #[arg(long, value_name = "g|m/s2|cm/s2")]
    pub units: Option<Units>,
    /// Factor on both components
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    pub scale: Option<f64>,
    /// Scale both components so that the horizontal peak is this, m/s^2
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    pub pga: Option<f64>,
}

/// The checked motion; files are looked for from `directory`.
pub(super) fn check_record(text: &RecordText, directory: &Path) -> Result<Pair, SceneError> {
    if let Some(dt) = text.dt {
        positive("dt", dt)?;
    }
    let told = Told { dt: text.dt, units: text.units, scaled: text.pga.is_some() };
    let read = |key, path: &Path| {
        let path = directory.join(path);
        read::file(&path, &told)
            .map_err(|error| SceneError::new(key, format!("{}: {error}", path.display())))
    };
    let Some(horizontal) = &text.horizontal else {
        return Err(SceneError::new("horizontal", "missing; give a record's file"));
    };
    let horizontal = read("horizontal", horizontal)?;
    let vertical = text.vertical.as_deref().map(|path| read("vertical", path)).transpose()?;
    let pair = Pair::new(horizontal, vertical);
    match (text.scale, text.pga) {
        (Some(_), Some(_)) => Err(SceneError::new("pga", "scale says it too; give one of them")),
        (Some(factor), None) => {
            if !(factor.is_finite() && factor != 0.0) {
                let problem = format!("{factor} must be a number other than zero");
                return Err(SceneError::new("scale", problem));
            }
            Ok(pair.scaled(factor))
        }
        (None, Some(pga)) => {
            let factor = positive("pga", pga)? / pair.pga_h;
            Ok(pair.scaled(factor))
        }
        (None, None) => Ok(pair),
    }
}
