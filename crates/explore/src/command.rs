//! A view as a command line and as a scene's file.

use std::path::PathBuf;

use serde::Deserialize;
use serde_json::{Value, json};

use super::asked::{self, AskedPrecision, Flat, SYNTHETIC};
use super::refused::Refused;
use super::session::Session;
use super::stage::AskedLimits;
use super::stages::{Stages, at_most};
use super::suite::FINEST;
use topple::model::precision::Precision;
use topple::scene::keys;
use topple::scene::parameters::{PARAMETERS, Section};
use topple::scene::{Grid, Scene, SceneBuilder, Values, shown};
use topple_studies::suites::envelope::Limits;

/// A request for what a view is, or for its files.
#[derive(Debug, Clone, Deserialize)]
pub struct MapRequest {
    /// The scene.
    pub scene: Flat,
    /// Cells along each axis.
    pub count: [u32; 2],
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
    /// The suite, where the view is one of shares over its motions.
    #[serde(default)]
    pub suite: Option<String>,
    /// The limits that a base must keep under it.
    #[serde(default)]
    pub limits: AskedLimits,
}

/// The command line and the file that make the map in view.
pub fn run(session: &Session, request: &MapRequest) -> Result<Value, Refused> {
    // The cells of the view at its finest.
    let count = Stages::of(&request.scene, request.count)?.count(0);
    let given = asked::builder(&request.scene, Some(count))?;
    if request.suite.is_some() {
        let count = at_most(&request.scene, request.count, FINEST)?;
        let given = asked::builder(&request.scene, Some(count))?;
        return Ok(json!({
            "command": envelope(session, &given, &request.limits.read()?),
            "toml": toml(session, &given)?,
        }));
    }
    let scene = session.records.check(&given)?;
    let precision = request.precision.of(&Grid::of(&scene));
    Ok(json!({
        "command": map(session, &given, &scene, precision),
        "toml": toml(session, &given)?,
    }))
}

/// The scene's file.
pub fn toml(session: &Session, given: &SceneBuilder) -> Result<String, Refused> {
    let mut written = given.clone();
    if let Some(record) = &mut written.record {
        for file in [&mut record.horizontal, &mut record.vertical].into_iter().flatten() {
            *file = session.records.written(file);
        }
    }
    written.to_toml().map_err(Refused::told)
}

/// The flags of a scene, in the order of its sections.
fn flags(session: &Session, given: &SceneBuilder) -> Vec<String> {
    let written = serde_json::to_value(given).unwrap_or_default();
    let mut flags = Vec::new();
    let mut flag = |name: &str, value: &str| flags.push(shown::word(&format!("--{name}={value}")));
    for section in Section::ALL {
        for key in keys::words(section).iter().filter(|key| !matches!(**key, "x" | "y")) {
            let text = match &written[section.key()][key] {
                Value::Null => continue,
                Value::String(text) => text.clone(),
                other => other.to_string(),
            };
            match *key {
                "shape" => flag("pulse", &text),
                "horizontal" | "vertical" if text == SYNTHETIC => {}
                "horizontal" | "vertical" => {
                    let place = session.records.written(&PathBuf::from(text));
                    flag(key, &place.to_string_lossy());
                }
                key => flag(&key.replace('_', "-"), &text),
            }
        }
        for entry in PARAMETERS.iter().filter(|entry| entry.section == section) {
            if let Some(values) = given.numbers.get(entry.parameter) {
                flag(entry.flag().trim_start_matches('-'), &values.to_string());
            }
        }
    }
    // One that needs no value.
    for text in flags.iter_mut().filter(|text| **text == "--force=true") {
        *text = "--force".into();
    }
    flags
}

/// How a number type is requested, where it is not the usual one.
fn precise(precision: Precision) -> Option<String> {
    (precision == Precision::F64).then(|| "--precision=f64".into())
}

fn line(command: &str, flags: impl IntoIterator<Item = String>) -> String {
    let words = [String::from("topple"), command.into()].into_iter().chain(flags);
    words.collect::<Vec<String>>().join(" ")
}

/// The command line that makes a map.
fn map(session: &Session, given: &SceneBuilder, scene: &Scene, precision: Precision) -> String {
    let command = if scene.excitation.record().is_some() { "seismic" } else { "pulse" };
    let grid = Grid::of(scene);
    let usual = Grid::of(&Scene { x: None, y: None, ..scene.clone() });
    // Axes are named where they would be others.
    let axes = (grid != usual).then(|| {
        ["x", "y"]
            .into_iter()
            .zip(grid.axes())
            .map(|(name, axis)| format!("--{name}={}", axis.key()))
    });
    let flags = flags(session, given).into_iter();
    line(command, flags.chain(axes.into_iter().flatten()).chain(precise(precision)))
}

/// The command line that makes the map of a suite. Where its files lay before they were dropped is not known.
fn envelope(session: &Session, given: &SceneBuilder, limits: &Limits) -> String {
    let suite = [String::from("--suite=RECORDS")];
    let numbers = [
        ("limit-u", limits.u),
        ("limit-v", limits.v),
        ("standing", Some(limits.standing).filter(|share| *share < 1.0)),
    ];
    let numbers =
        numbers.into_iter().filter_map(|(name, value)| Some(format!("--{name}={}", value?)));
    let axes = [("x", given.x), ("y", given.y)];
    let axes = axes.into_iter().filter_map(|(name, key)| Some(format!("--{name}={}", key?.key())));
    line("envelope", flags(session, given).into_iter().chain(axes).chain(suite).chain(numbers))
}

/// The command line that makes the history of a cell.
pub fn history(session: &Session, given: &SceneBuilder, precision: Precision) -> String {
    let single = given.numbers.iter().all(|(_, values): (_, &Values)| values.count() == 1);
    debug_assert!(single);
    line("history", flags(session, given).into_iter().chain(precise(precision)))
}
