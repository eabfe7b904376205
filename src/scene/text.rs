//! Scenes as written: TOML files and, with the same keys as flags, the command line.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::block::{self, BlockText};
use super::excitation::{self, Excitation, PulseText, RecordText};
use super::isolation::{self, IsolationText};
use super::{Overturn, Scene, SceneError, positive};

/// A scene as written. Keys and units are those of the command line.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneText {
    /// One line for figures and manifests.
    pub title: Option<String>,
    /// The block and its plates.
    #[serde(default)]
    pub block: BlockText,
    /// The base.
    #[serde(default)]
    pub base: IsolationText,
    /// The pulse.
    pub pulse: Option<PulseText>,
    /// The record; either this or the pulse.
    pub record: Option<RecordText>,
    /// Duration and criteria.
    #[serde(default)]
    pub run: RunText,
}

/// Duration and criteria as written.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct RunText {
    /// Simulated time, s [default: 30, or a record's duration]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub t_max: Option<f64>,
    /// Rotation of the block at the start, rad, positive about the left corner [default: 0]
    #[arg(long, value_name = "PHI", allow_negative_numbers = true)]
    pub tilt: Option<f64>,
    /// When a block counts as overturned [default: critical-angle]
    #[arg(long, value_name = "WHEN")]
    pub overturn: Option<Overturn>,
    /// Friction coefficient of the contact: mark cells that ask for more, where the block would
    /// slide
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    pub friction: Option<f64>,
    /// Angular velocity after an impact over the one before, in place of the law (only with
    /// isolation none)
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    pub restitution: Option<f64>,
}

/// Longest simulated time, s.
const LONGEST: f64 = 1.0e5;

impl SceneText {
    /// Reads a scene from TOML.
    ///
    /// # Errors
    /// One line with the line and column at fault: a syntax error, an unknown key, a wrong type.
    pub fn from_toml(text: &str) -> Result<SceneText, String> {
        toml::from_str(text).map_err(|error| located(text, &error))
    }

    /// Checks the scene; a record's files are looked for from the working directory.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check(&self) -> Result<Scene, SceneError> {
        self.check_in(Path::new(""))
    }

    /// Checks the scene; a record's files are looked for from `directory`.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check_in(&self, directory: &Path) -> Result<Scene, SceneError> {
        self.check_shaken_by(|| match (&self.pulse, &self.record) {
            (Some(_), Some(_)) => {
                let problem = "a scene has a pulse or a record; leave one out";
                Err(SceneError::new("record", problem))
            }
            (_, Some(record)) => {
                Ok(Excitation::Record(excitation::check_record(record, directory)?))
            }
            (pulse, None) => {
                let pulse = pulse.clone().unwrap_or_default();
                Ok(Excitation::Pulse(excitation::check_pulse(&pulse)?))
            }
        })
    }

    /// Checks the scene under an excitation that is at hand; its own pulse or record is not read.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check_under(&self, excitation: Excitation) -> Result<Scene, SceneError> {
        self.check_shaken_by(|| Ok(excitation))
    }

    fn check_shaken_by(
        &self,
        excitation: impl FnOnce() -> Result<Excitation, SceneError>,
    ) -> Result<Scene, SceneError> {
        let (block, plate_h, plate_v) = block::check(&self.block)?;
        let isolation = isolation::check(&self.base, plate_h, plate_v)?;
        let excitation = excitation()?;
        for (key, range) in [
            ("t_h", isolation.horizontal.map(|base| base.t_h)),
            ("t_v", isolation.vertical.map(|base| base.t_v)),
        ] {
            let pulse = matches!(excitation, Excitation::Pulse(_));
            if pulse && range.is_some_and(|range| range.count > 1) {
                let problem = "a pulse map sweeps omega and a_h; give this a single number";
                return Err(SceneError::new(key, problem));
            }
        }
        let (default_title, shortest) = match &excitation {
            Excitation::Pulse(_) => ("Overturning spectral map", 30.0),
            Excitation::Record(pair) => ("Rocking map", pair.duration()),
        };
        let t_max = positive("t_max", self.run.t_max.unwrap_or(shortest))?;
        if matches!(excitation, Excitation::Record(_)) && t_max < shortest {
            let problem = format!("{t_max} s ends before the record, {shortest} s; lengthen it");
            return Err(SceneError::new("t_max", problem));
        }
        if t_max > LONGEST {
            return Err(SceneError::new("t_max", format!("{t_max} s is over {LONGEST} s")));
        }
        if let Some(restitution) = self.run.restitution {
            if isolation.horizontal.is_some() || isolation.vertical.is_some() {
                let problem = "replaces the law of impact only with isolation none";
                return Err(SceneError::new("restitution", problem));
            }
            if !(restitution > 0.0 && restitution <= 1.0) {
                let problem = format!("{restitution} must lie above 0 and at most at 1");
                return Err(SceneError::new("restitution", problem));
            }
        }
        let friction = self.run.friction.map(|mu| positive("friction", mu)).transpose()?;
        let scene = Scene {
            title: self.title.clone().unwrap_or_else(|| default_title.into()),
            block,
            isolation,
            excitation,
            t_max,
            tilt: self.run.tilt.unwrap_or(0.0),
            overturn: self.run.overturn.unwrap_or(Overturn::CriticalAngle),
            friction,
            restitution: self.run.restitution,
        };
        let most = scene.overturning_angle(scene.tilt.signum());
        if !(scene.tilt.abs() < most) {
            let problem =
                format!("{} must be below the overturning angle, {most:.4} rad", scene.tilt);
            return Err(SceneError::new("tilt", problem));
        }
        Ok(scene)
    }
}

/// A parser's message with its line and column, in one line.
pub(crate) fn located(text: &str, error: &toml::de::Error) -> String {
    let place = error.span().map(|span| {
        let before = &text[..span.start.min(text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        format!("line {line}, column {column}: ")
    });
    let message: Vec<&str> = error.message().split_whitespace().collect();
    format!("{}{}", place.unwrap_or_default(), message.join(" "))
}
