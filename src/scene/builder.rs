//! Scenes as a user gives them: by types, by TOML files, and by the flags of the command line, which have the same keys.

use std::path::Path;

use super::applies::{Choice, ShakenBy};
use super::excitation::{self, Excitation};
use super::numbers::Numbers;
use super::parameters::Parameter;
use super::record::text::printable;
use super::record::{Pair, RecordText};
use super::{Directions, Overturn, Pressure, Scene, SceneError, Values};
use super::{block, check, isolation, shown};
use crate::model::pulse::Shape;

/// The titles of scenes without a title of their own: of a pulse and of a record.
pub const TITLES: [&str; 2] = ["Overturning spectral map", "Rocking map"];

/// The numbers and choices of a scene that a user has given. A missing one has a default or is an error of [`check`](SceneBuilder::check).
/// Keys and units are those of the command line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneBuilder {
    /// One line for figures and manifests.
    pub title: Option<String>,
    /// A block of Table 1.
    pub object: Option<u32>,
    /// Directions in which the base moves.
    pub isolation: Option<Directions>,
    /// The vertical force on a friction pendulum.
    pub pressure: Option<Pressure>,
    /// When a block counts as overturned.
    pub overturn: Option<Overturn>,
    /// The shape of the pulse, if there is one.
    pub shape: Option<Shape>,
    /// The record's files, where there is one; either a record or a pulse.
    pub record: Option<RecordText>,
    /// All numbers.
    pub numbers: Numbers,
    /// True to accept implausible numbers.
    pub force: bool,
    /// The parameter along the picture's horizontal axis.
    pub x: Option<Parameter>,
    /// The parameter along its vertical axis.
    pub y: Option<Parameter>,
}

impl SceneBuilder {
    /// A block of Table 1 of the paper with its plates: 1 caryatid, 2 server cabinet, 3 hospital cabinet.
    pub fn object(number: u32) -> SceneBuilder {
        SceneBuilder { object: Some(number), ..SceneBuilder::default() }
    }

    /// The same with a number: one value, or several that make an axis.
    pub fn with(mut self, parameter: Parameter, values: impl Into<Values>) -> SceneBuilder {
        self.numbers.set(parameter, values);
        self
    }

    /// The same with a base that moves in these directions.
    pub fn isolated(self, isolation: Directions) -> SceneBuilder {
        SceneBuilder { isolation: Some(isolation), ..self }
    }

    /// The same under pulses of a shape.
    pub fn pulse(self, shape: Shape) -> SceneBuilder {
        SceneBuilder { shape: Some(shape), ..self }
    }

    /// Reads a scene from TOML.
    ///
    /// # Errors
    /// One line with the line and column at fault: a syntax error, an unknown key, a wrong type.
    pub fn from_toml(text: &str) -> Result<SceneBuilder, String> {
        toml::from_str(text).map_err(|error| located(text, &error))
    }

    /// The builder that makes a checked scene again; the files of its record lie where `record` says.
    pub fn again(scene: &Scene, record: Option<RecordText>) -> SceneBuilder {
        let shape = match scene.excitation {
            Excitation::Pulse(shape) => Some(shape),
            Excitation::Record(_) => None,
        };
        SceneBuilder {
            title: Some(scene.title.clone()),
            // Its numbers are among the scene's.
            object: None,
            isolation: Some(scene.isolation),
            pressure: scene.pressure,
            overturn: Some(scene.overturn),
            shape,
            record,
            numbers: scene.numbers.clone(),
            // What it has was accepted once.
            force: true,
            x: scene.x,
            y: scene.y,
        }
    }

    /// Writes the scene as TOML, which [`from_toml`](SceneBuilder::from_toml) reads.
    ///
    /// # Errors
    /// The writer's: a path that is no text.
    pub fn to_toml(&self) -> Result<String, String> {
        toml::to_string(self).map_err(|error| error.to_string())
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
        let not_under = |by| self.numbers.excluded_by(Choice::Excitation(by));
        let recorded = self.record.is_some() || not_under(ShakenBy::Pulse).is_some();
        if recorded && (self.shape.is_some() || not_under(ShakenBy::Record).is_some()) {
            let problem = "a scene has a pulse or a record; leave one out";
            let key = self.record.as_ref().map_or("horizontal", RecordText::first_key);
            return Err(SceneError::new(key, problem));
        }
        self.check_shaken_by(|| {
            if !recorded {
                return Ok(Excitation::Pulse(self.shape.unwrap_or_default()));
            }
            let none = RecordText::default();
            let files = self.record.as_ref().unwrap_or(&none);
            let pair = excitation::check_record(files, &self.numbers, directory, self.force)?;
            Ok(Excitation::Record(pair))
        })
    }

    /// Checks the scene under an excitation that is at hand; its own record is not read.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check_under(&self, excitation: Excitation) -> Result<Scene, SceneError> {
        self.check_shaken_by(|| Ok(excitation))
    }

    /// Checks the scene under a motion at hand, with the record that follows it, on the scene's floor, scaled by its factor or to
    /// its peak.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check_under_motion(&self, pair: Pair) -> Result<Scene, SceneError> {
        self.check_under_motion_in(pair, Path::new(""))
    }

    /// The same; a file that follows is looked for from `directory`.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check_under_motion_in(&self, pair: Pair, directory: &Path) -> Result<Scene, SceneError> {
        if let Some(parameter) = self.numbers.excluded_by(Choice::Excitation(ShakenBy::Record)) {
            let problem = "a record shakes the base, not a pulse; leave it out";
            return Err(SceneError::new(parameter.key(), problem));
        }
        self.check_shaken_by(|| {
            let none = RecordText::default();
            let text = self.record.as_ref().unwrap_or(&none);
            let pair = excitation::check_motion(pair, text, &self.numbers, directory, self.force)?;
            Ok(Excitation::Record(pair))
        })
    }

    fn check_shaken_by(
        &self,
        excitation: impl FnOnce() -> Result<Excitation, SceneError>,
    ) -> Result<Scene, SceneError> {
        check::title(self.title.as_deref().unwrap_or_default())?;
        check::numbers(&self.numbers, self.force)?;
        let directions = self.isolation.unwrap_or(Directions::Dual);
        let mut numbers = self.numbers.clone();
        block::complete(self.object, &mut numbers)?;
        isolation::complete(directions, &mut numbers)?;
        let excitation = excitation()?;
        let (default_title, shortest) = match &excitation {
            Excitation::Pulse(shape) => {
                excitation::complete_pulse(*shape, &mut numbers)?;
                (TITLES[0], 30.0)
            }
            Excitation::Record(pair) => (TITLES[1], pair.duration()),
        };
        numbers.set_missing(Parameter::TMax, shortest);
        numbers.set_missing(Parameter::Tilt, 0.0);
        let pressure = self.check_pressure(&numbers)?;
        let scene = Scene {
            title: self.title.as_deref().map_or_else(|| default_title.into(), printable),
            isolation: directions,
            pressure,
            overturn: self.overturn.unwrap_or(Overturn::CriticalAngle),
            excitation,
            numbers,
            x: self.x,
            y: self.y,
        };
        check::scene(&scene)?;
        if !self.force {
            check::plausible_device(&scene)?;
        }
        Ok(scene)
    }
}

impl SceneBuilder {
    /// What presses on the base's friction pendulum, where it is one.
    fn check_pressure(&self, numbers: &Numbers) -> Result<Option<Pressure>, SceneError> {
        if numbers.has(Parameter::Radius) {
            return Ok(Some(self.pressure.unwrap_or(Pressure::Follows)));
        }
        match self.pressure {
            Some(_) => {
                let problem = "is of a friction pendulum; give `radius` and `mu`, or leave it out";
                Err(SceneError::new("pressure", problem))
            }
            None => Ok(None),
        }
    }
}

/// A parser's message with its line and column, in one line.
pub fn located(text: &str, error: &toml::de::Error) -> String {
    let place = error.span().map(|span| {
        let before = &text[..span.start.min(text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        format!("line {line}, column {column}: ")
    });
    let message: Vec<&str> = error.message().split_whitespace().collect();
    let line = error.span().map(|span| line_at(text, span.start)).unwrap_or_default();
    let value = line.split_once('=').map_or("", |(_, value)| value);
    let hint = match value.contains(':') && !value.contains('"') {
        true => "; a range stands in quotes, as in \"0.5:4:400\"",
        false => "",
    };
    format!("{}{}{hint}", place.unwrap_or_default(), shown::line(&in_words(&message.join(" "))))
}

/// The line of a text at a byte offset.
fn line_at(text: &str, place: usize) -> &str {
    let place = place.min(text.len());
    let start = text[..place].rfind('\n').map_or(0, |end| end + 1);
    text[start..].lines().next().unwrap_or_default()
}

/// A parser's message without the words of a programming language.
fn in_words(message: &str) -> String {
    if let Some((found, expected)) =
        message.strip_prefix("invalid type: ").and_then(|rest| rest.split_once(", expected "))
    {
        let found = found.replace("floating point", "number").replace("integer", "number");
        let found = found.replace("string", "text").replace("boolean ", "").replace('`', "");
        let expected = match expected {
            "u32" => "a whole number",
            "f64" => "a number",
            "a string" => "a text in quotes",
            "a boolean" => "true or false",
            "path string" => "the path of a file in quotes",
            other => other,
        };
        return format!("{found} stands where {expected} belongs");
    }
    match message.strip_prefix("unknown variant ").and_then(|rest| rest.split_once(", expected ")) {
        Some((found, known)) => {
            format!("{found} is not known here; give {known}")
        }
        None => message.into(),
    }
}
